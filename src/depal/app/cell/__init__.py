"""`depal cell check`: what a cell can do, as a table and as a picture."""
