"""`depal cell check`: what a cell can do, as a table and as a picture."""

from depal.app.cell.picture import cell_picture
from depal.app.cell.report import cell_report

__all__ = ["cell_picture", "cell_report"]
