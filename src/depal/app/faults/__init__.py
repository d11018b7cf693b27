"""`depal study faults`: every fault alone, seed by seed, pairs of them, cuts and long shifts."""

from depal.app.faults.pieces import Piece
from depal.app.faults.report import faults_report, replay_report
from depal.app.faults.runs import FaultsAsked, faults_rows, run_one
from depal.app.faults.shift import shift_report, shift_with_physics
from depal.app.faults.whole import Whole, whole_report

__all__ = [
    "FaultsAsked",
    "Piece",
    "Whole",
    "faults_report",
    "faults_rows",
    "replay_report",
    "run_one",
    "shift_report",
    "shift_with_physics",
    "whole_report",
]
