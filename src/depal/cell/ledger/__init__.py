"""What a cell must still know after a restart, written before and after every physical step."""

from depal.cell.hand import Hand, Phase
from depal.cell.ledger.book import Ledger
from depal.cell.ledger.page import KeptBox, LeftBox, Page, PiledBox, page_of, restore
from depal.cell.ledger.reconciling import Found, Sensed, reconcile

__all__ = [
    "Found",
    "Hand",
    "KeptBox",
    "Ledger",
    "LeftBox",
    "Page",
    "Phase",
    "PiledBox",
    "Sensed",
    "page_of",
    "reconcile",
    "restore",
]
