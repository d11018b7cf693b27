"""`depal serve`: the cell in a thread, its world in a process, the store's side before both."""
