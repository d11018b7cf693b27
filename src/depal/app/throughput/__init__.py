"""`depal study throughput`: many deliveries emptied in the simulated cell, summed up."""

from depal.app.throughput.asked import Asked
from depal.app.throughput.report import throughput_report
from depal.app.throughput.row import Row
from depal.app.throughput.runs import Failure, Throughput, throughput
from depal.app.throughput.summary import Summary, summary_of

__all__ = [
    "Asked",
    "Failure",
    "Row",
    "Summary",
    "Throughput",
    "summary_of",
    "throughput",
    "throughput_report",
]
