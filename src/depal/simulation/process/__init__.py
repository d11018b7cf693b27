"""The simulated world in a process of its own: it outlives the controller that works in it."""
