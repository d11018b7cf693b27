"""Whether a cell can do its work: reach, sight, room, and what a delivery asks of it."""

from depal.cell.checking.check import CellReport, check_cell
from depal.cell.checking.delivery import check_delivery_against_cell
from depal.cell.checking.findings import CellFinding, Weight
from depal.cell.checking.pallet_reach import PalletReach
from depal.cell.checking.place_reach import PlaceReach
from depal.cell.checking.reader_reach import ReaderReach
from depal.cell.checking.sight import Sight
from depal.cell.checking.sizes import USUAL, BoxSize, sizes_of

__all__ = [
    "USUAL",
    "BoxSize",
    "CellFinding",
    "CellReport",
    "PalletReach",
    "PlaceReach",
    "ReaderReach",
    "Sight",
    "Weight",
    "check_cell",
    "check_delivery_against_cell",
    "sizes_of",
]
