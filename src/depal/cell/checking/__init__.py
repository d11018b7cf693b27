"""Whether a cell can do its work: reach, sight, room, and what a delivery asks of it."""
