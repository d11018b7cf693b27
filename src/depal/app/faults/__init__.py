"""`depal study faults`: every fault alone, seed by seed."""

from depal.app.faults.report import faults_report
from depal.app.faults.runs import FaultsAsked, faults_rows

__all__ = ["FaultsAsked", "faults_report", "faults_rows"]
