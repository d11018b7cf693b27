"""`depal study retrieval`: what is asked, and how it is worked off."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

from depal.app.run.inputs import cell_of
from depal.app.unload import deliveries_of
from depal.domain import checked_share
from depal.errors import SettingError
from depal.studies.pallets import named_generators
from depal.studies.retrieval import (
    Checked,
    Row,
    StackPiece,
    StackRows,
    checked,
    random_rows,
    real_rows,
    stack_rows,
)
from depal.studies.sweep import Progress, sweep


@dataclass(frozen=True, slots=True)
class RetrievalAsked:
    """The options of the study.

    Attributes:
        pallets: random pallets of each generator.
        generators: their names, with commas between them.
        side_only: shares of boxes that only a side grasp can take, with commas between them.
        cell_pallets: so many of the pallets are worked on with clearance and reach as well.
        deliveries: a file of deliveries, FILE#ID, or "" for those that ship.
        cell: whose clearance and reach count.
        referee: on so many pallets of each generator another program proves the minimum again.
        seed: of every random number.
    """

    pallets: int
    generators: str
    side_only: str
    cell_pallets: int
    deliveries: str
    cell: str
    referee: int
    seed: int


@dataclass(frozen=True, slots=True)
class RetrievalResult:
    """What was found.

    Attributes:
        rows: of the random pallets and of all deliveries together.
        stacks: per delivery, without and then with clearance.
        checked: per generator how often the second program agreed.
    """

    rows: tuple[Row, ...]
    stacks: tuple[StackRows, ...]
    checked: tuple[Checked, ...]


def shares_of(text: str) -> tuple[float, ...]:
    """The shares in a list with commas, each once, rising.

    Raises:
        SettingError: one of them is no number in [0, 1].
    """
    shares = set()
    for word in text.split(","):
        try:
            shares.add(checked_share("--side-only", float(word)))
        except ValueError:
            what = f"{word.strip()!r} is not a number"
            raise SettingError("--side-only", what, "shares such as 0,0.25,0.5") from None
    return tuple(sorted(shares))


def retrieval(
    asked: RetrievalAsked, executor: Executor | None, progress: Progress
) -> RetrievalResult:
    """Works the study off.

    Raises:
        InputError: an option names what there is not.
    """
    names, shares = named_generators(asked.generators), shares_of(asked.side_only)
    layout = cell_of(asked.cell)
    deliveries = deliveries_of(asked.deliveries)
    inside = min(asked.cell_pallets, asked.pallets)
    total = len(names) * (asked.pallets + inside) + 2 * len(deliveries) + len(names)
    done = 0
    rows: list[Row] = []
    for name in names:
        # In the cell a front that the arm does not reach leaves a side-only box for ever.
        for place, count, kinds in ((None, asked.pallets, shares), (layout, inside, (0.0,))):
            bar = _part_of(progress, done, count, total)
            if count:
                rows += random_rows(name, count, asked.seed, kinds, place, executor, bar)
            done += count
    stacks: list[StackRows] = []
    for place in (None, layout):
        pieces = [StackPiece(delivery, place) for delivery in deliveries]
        bar = _part_of(progress, done, len(deliveries), total)
        found = sweep(stack_rows, pieces, executor, bar)
        rows += real_rows(found)
        stacks += [each for each, _ in found]
        done += len(deliveries)
    referees = [(name, asked.seed, asked.referee) for name in names if asked.referee]
    agreed = sweep(checked, referees, executor, _part_of(progress, done, len(names), total))
    return RetrievalResult(tuple(rows), tuple(stacks), tuple(agreed))


def _part_of(progress: Progress, before: int, count: int, total: int) -> Progress:
    """The progress of a part of the work, as progress of the whole."""
    return lambda done, of: progress(before + round(count * done / max(of, 1)), total)


def worse(stacks: Sequence[StackRows]) -> int:
    """Requests for which `access` took more actions than `paper` under one model."""
    return sum(stack.above for stack in stacks)
