"""The whole check of a cell."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from depal.cell.checking.findings import CellFinding, Weight, error, warning
from depal.cell.checking.mover import Mover
from depal.cell.checking.pallet_reach import PalletReach, check_pallet_reach
from depal.cell.checking.place_reach import PlaceReach, check_place_reach
from depal.cell.checking.reader_reach import ReaderReach, check_reader_reach
from depal.cell.checking.sight import Sight, check_sight
from depal.cell.checking.sizes import USUAL, BoxSize
from depal.cell.checking.standing import check_standing
from depal.domain import Approach, CellLayout, PlaceId

ALMOST_ALL = 0.99
"""Less of the pallet that is reached is worth a warning."""

LITTLE = 0.5
"""Less of the pallet that is reached, or of its front that is seen, is an error."""

SHALLOW = 0.3
"""A smaller share of a place that is reached is worth a warning."""


@dataclass(frozen=True, slots=True)
class CellReport:
    """What a cell can do.

    Attributes:
        cell: its name.
        sizes: the boxes that were tried.
        pallet: what of the pallet's load is reached, by size.
        places: how deep boxes go into places, by place, size and grasp.
        reader: what can be shown to the reader, by size and grasp.
        sights: what the cameras see of the pallet's front; all together last.
        findings: errors and warnings, in the order of the cell file.
    """

    cell: str
    sizes: tuple[BoxSize, ...]
    pallet: tuple[PalletReach, ...]
    places: tuple[PlaceReach, ...]
    reader: tuple[ReaderReach, ...]
    sights: tuple[Sight, ...]
    findings: tuple[CellFinding, ...]

    @property
    def holds(self) -> bool:
        """Whether the cell can do its work: there are no errors."""
        return all(finding.weight is not Weight.ERROR for finding in self.findings)

    def held(self, size: BoxSize, approach: Approach) -> bool:
        """Whether there is a way to hold a box by its front or by its top."""
        return any(
            reach.held for reach in self.reader if reach.size == size and reach.approach is approach
        )

    @property
    def reached(self) -> dict[PlaceId, float]:
        """The share of each place that is reached by the better grasp, mean over the sizes."""
        best: dict[PlaceId, dict[str, float]] = {}
        for reach in self.places:
            by_size = best.setdefault(reach.place, {})
            if reach.fits:
                by_size[reach.size.name] = max(by_size.get(reach.size.name, 0.0), reach.reached)
        return {
            place: sum(by_size.values()) / len(by_size) if by_size else 0.0
            for place, by_size in best.items()
        }


def check_cell(layout: CellLayout, sizes: Sequence[BoxSize] = USUAL) -> CellReport:
    """Everything that can be said about a cell before anything moves in it.

    Args:
        layout: the cell.
        sizes: the boxes to try.

    Returns:
        What it reaches and sees, and what is wrong with it.

    Raises:
        CellError: the arm's kinematics have no closed form here.
    """
    mover = Mover(layout)
    pallet = check_pallet_reach(mover, layout.pallet, sizes)
    places = check_place_reach(mover, layout, sizes)
    reader = check_reader_reach(mover, layout.reader, sizes)
    sights = check_sight(layout)
    findings = [
        *_parked(mover),
        *check_standing(layout),
        *_pallet(pallet),
        *_places(places),
        *_sights(sights),
        *_reader(reader),
    ]
    return CellReport(layout.name, tuple(sizes), pallet, places, reader, sights, tuple(findings))


def _parked(mover: Mover) -> Iterator[CellFinding]:
    hit = mover.parked_hits()
    if hit:
        yield error("robot.parked", f"the parked arm touches something: {hit}", "a free posture")
    for zone in mover.parked_in():
        what = "the parked arm reaches into it: no task that avoids it can begin there"
        yield warning(f"zone {zone}", what, "a zone or a posture elsewhere")


def _pallet(reaches: Sequence[PalletReach]) -> Iterator[CellFinding]:
    for reach in reaches:
        name, share = reach.size.name, 100 * reach.usual
        what = f"{share:.1f} % of it is reached with a {name} box"
        if reach.usual < LITTLE:
            yield error("pallet", f"only {what}", "a pallet within the arm's reach")
        elif reach.usual < ALMOST_ALL:
            missed = ", ".join(f"({x:.2f}, {y:.2f}, {z:.2f})" for x, y, z in reach.missed[:3])
            yield warning("pallet", what, "99 %", f"not reached, among others: {missed}")


def _places(reaches: Sequence[PlaceReach]) -> Iterator[CellFinding]:
    places = dict.fromkeys(reach.place for reach in reaches)
    for place in places:
        here = [reach for reach in reaches if reach.place == place]
        if not any(reach.fits for reach in here):
            yield warning(place, "none of the boxes fits into it", "a larger opening")
        elif all(reach.reached == 0 for reach in here):
            yield error(place, "cannot be reached", "a place where the arm can set a box down")
        else:
            most = max(reach.reached for reach in here)
            if most < SHALLOW:
                deepest = max(reach.deepest for reach in here)
                what = f"{100 * most:.0f} % of it is reached, {deepest:.2f} m deep"
                yield warning(place, what, f"{100 * SHALLOW:.0f} % or more")


def _sights(sights: Sequence[Sight]) -> Iterator[CellFinding]:
    whole = sights[-1]
    if whole.seen == 1.0:
        return
    before = ", ".join(
        f"{name} ({100 * share:.0f} %)" for sight in sights for name, share in sight.hidden_by
    )
    what = f"{100 * whole.seen:.0f} % of the pallet's front is in view"
    exists = f"before the rest: {before}" if before else ""
    say = error if whole.seen < LITTLE else warning
    yield say("camera", what, "all of it up to 1.75 m, with the arm parked", exists)


def _reader(reaches: Sequence[ReaderReach]) -> Iterator[CellFinding]:
    if not any(reach.sides for reach in reaches):
        yield error("reader", "no held box can be shown to it", "a reader within reach")
        return
    for reach in reaches:
        if reach.held and not reach.sides:
            held = f"a {reach.size.name} box held {reach.approach.value}ly"
            yield warning("reader", f"{held} cannot be shown to it")
