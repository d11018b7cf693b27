"""What is printed on the boxes of the simulated cell, and the labels on them."""

from depal.simulation.imaging.prints.boxes import PrintedBoxes
from depal.simulation.imaging.prints.design import Design, Stock, design_of
from depal.simulation.imaging.prints.label import Label, label_for

__all__ = ["Design", "Label", "PrintedBoxes", "Stock", "design_of", "label_for"]
