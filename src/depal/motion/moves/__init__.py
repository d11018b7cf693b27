"""Whole motions: to a box and off the pile with it, into a place and out again, to the reader.

Everything is a path of joint angles in named parts; when the arm is where, `timing` says. What
cannot be done comes back with its reason.
"""

from depal.motion.moves.margins import CLOSE, ENTRY, OPEN
from depal.motion.moves.mover import Mover
from depal.motion.moves.putting import Berth
from depal.motion.moves.values import SURE, Doubts, Kind, NoMotion, Part, Pick, Put

__all__ = [
    "CLOSE",
    "ENTRY",
    "OPEN",
    "SURE",
    "Berth",
    "Doubts",
    "Kind",
    "Mover",
    "NoMotion",
    "Part",
    "Pick",
    "Put",
]
