"""`depal study faults`: every fault alone, seed by seed, and pairs of them."""

from depal.app.faults.pieces import Piece
from depal.app.faults.report import faults_report, replay_report
from depal.app.faults.runs import FaultsAsked, faults_rows, run_one

__all__ = ["FaultsAsked", "Piece", "faults_report", "faults_rows", "replay_report", "run_one"]
