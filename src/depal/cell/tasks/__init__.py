"""The repository of tasks: `store.task` is the paper's running example, `cell.task` the rest.

The two files are read together; a cell with other tasks brings other files.
"""
