"""What each action of the task files does: one class per part of the work."""
