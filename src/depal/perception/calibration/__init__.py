"""Where a camera stands and how its depths are scaled, from markers fixed to the cell."""
