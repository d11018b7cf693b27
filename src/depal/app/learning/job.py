"""Reads records, learns, and checks what was learned on pallets that it was not learned from."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from depal.app.learning.order_file import ENDINGS, read_orders
from depal.app.learning.run_record import CHOICES, read_run
from depal.errors import OrderError, PileError, Problem
from depal.selection.learning import Choice, Choices, Learned, learn, steps_of
from depal.studies.learning import HeldOut, bootstrapped, held_out
from depal.studies.sweep import Progress, no_progress


@dataclass(frozen=True, slots=True)
class Lesson:
    """What was read and what was learned.

    Attributes:
        sources: what was read, in order.
        pallets: how many pallets.
        forced: boxes that left when nothing else could be taken.
        blocked: boxes that left although another one stood on or before them.
        learned: from all of it; intervals by a bootstrap over pallets where one was made.
        resamples: of that bootstrap.
        check: on pallets that were held out; None where there are too few.
    """

    sources: tuple[str, ...]
    pallets: int
    forced: int
    blocked: int
    learned: Learned
    resamples: int
    check: HeldOut | None


def learn_from(
    paths: Sequence[Path], seed: int = 0, resamples: int = 0, progress: Progress = no_progress
) -> Lesson:
    """Learns from records of runs and files of orders.

    Args:
        paths: folders of `depal run --record`, folders of such folders, and .jsonl files.
        seed: of which pallets are held out, and of the bootstrap.
        resamples: for intervals by a bootstrap over pallets; 0 for Fisher's information.
        progress: told how far the bootstrap is.

    Raises:
        OrderError: with everything that is wrong with the first input that is wrong.
    """
    pallets: list[tuple[Choice, ...]] = []
    forced = blocked = 0
    for path in paths:
        for found, single, under in _read(path):
            pallets.append(found)
            forced += single
            blocked += under
    choices = Choices.of(pallets)
    learned = learn(choices)
    if resamples:
        learned = bootstrapped(choices, learned, resamples, seed, progress)
    return Lesson(
        sources=tuple(map(str, paths)),
        pallets=len(pallets),
        forced=forced,
        blocked=blocked,
        learned=learned,
        resamples=resamples,
        check=held_out(choices, seed),
    )


def _read(path: Path) -> list[tuple[tuple[Choice, ...], int, int]]:
    """Per pallet its choices, forced steps and blocked boxes."""
    if (path / CHOICES).is_file():
        run = read_run(path)
        return [(run.choices, run.forced, 0)]
    if path.is_dir():
        folders = sorted(each.parent for each in path.glob(f"*/{CHOICES}"))
        if not folders:
            expected = "the folder of a record, or one that holds such folders"
            raise OrderError(str(path), [Problem("", f"holds no {CHOICES}", expected)])
        return [entry for folder in folders for entry in _read(folder)]
    if path.exists() and path.suffix not in ENDINGS:
        what = f"is no record: {path.suffix or 'no ending'}"
        raise OrderError(str(path), [Problem("", what, "a folder of a record or a .jsonl file")])
    rows = []
    for order in read_orders(path):
        try:
            steps = steps_of(order)
        except PileError as error:
            raise OrderError(str(path), error.problems) from None
        rows.append((steps.choices, steps.forced, len(steps.blocked)))
    return rows
