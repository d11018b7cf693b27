"""`depal study due`: which kinds of pallets are worked off."""

from concurrent.futures import Executor

from depal.studies.due import DuePiece, DueRow, due_rows, small_pallets
from depal.studies.sweep import Progress

SIDES = 0.5
"""The share of side-only boxes of the second row of small pallets."""


def due(
    generators: tuple[str, ...],
    pallets: int,
    small: int,
    seed: int,
    executor: Executor | None,
    progress: Progress,
) -> list[DueRow]:
    """Per generator: all requests from the start, random arrivals, and small pallets twice.

    Args:
        generators: their names.
        pallets: how many of each.
        small: how many of each with at most ten boxes, beside the exact optimum.
        seed: of the study.
        executor: who works; None for this process.
        progress: told how far it is.
    """
    pieces: list[DuePiece] = []
    for name in generators:
        every = tuple(range(pallets))
        pieces += [DuePiece(name, 0.0, kind, seed, every) for kind in ("start", "random")]
        if small:
            some = tuple(small_pallets(name, seed, small))
            pieces += [
                DuePiece(name, share, "start", seed, some, small=True) for share in (0.0, SIDES)
            ]
    total = sum(len(piece.indices) for piece in pieces)
    rows: list[DueRow] = []
    before = 0
    for piece in pieces:
        count = len(piece.indices)
        rows += due_rows(piece, executor, _part_of(progress, before, count, total))
        before += count
    return rows


def _part_of(progress: Progress, before: int, count: int, total: int) -> Progress:
    """The progress of a part of the work, as progress of the whole."""
    return lambda done, of: progress(before + round(count * done / max(of, 1)), total)
