"""What the study runs, and that its referee finds what is wrong."""

from collections.abc import Mapping
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tiny_runs import THREE, run

from depal.app.faults.pieces import Piece, pairs_of
from depal.app.faults.rows import Pairs, RecoveryRow, Row
from depal.app.faults.runs import Ran, job_of, run_one
from depal.app.faults.verdicts import Verdict, broken_in
from depal.app.run.inspecting import FALLING, undue
from depal.app.run.job import run_job
from depal.app.run.request_ends import wrong_ends
from depal.cell.departures import Departure, Departures
from depal.cell.files import shipped_cell
from depal.cell.planning.trolleys import Trolleys
from depal.cell.wishes import Wish
from depal.domain import BoxId, Gtin, PlaceId, Request
from depal.logistics.store import KeptRequest, RequestState
from depal.ports.fakes import FakeBays
from depal.simulation.contacts import Collision
from depal.simulation.faults import CATALOGUE, Fault, FaultPlan
from depal.simulation.referee import Referee

IDS = st.lists(st.sampled_from(sorted(CATALOGUE)), min_size=1, max_size=2)


@given(ids=IDS, seed=st.integers(0, 10**6))
def test_a_run_is_named_so_that_it_can_be_run_again(ids: list[str], seed: int) -> None:
    """Text and back."""
    piece = Piece(tuple(ids), seed)
    assert Piece.of(str(piece)) == piece


@given(count=st.integers(0, 50), seed=st.integers(0, 1000))
def test_pairs_are_of_different_faults_and_the_same_for_a_seed(count: int, seed: int) -> None:
    """A longer study begins with the shorter one's pairs."""
    ids = tuple(CATALOGUE)
    pairs = pairs_of(ids, count, seed)
    assert len(pairs) == count == len({pair.seed for pair in pairs})
    assert all(len(set(pair.ids)) == 2 for pair in pairs)
    assert pairs_of(ids, count + 5, seed)[:count] == pairs


@given(at=st.floats(0.0, 10.0), box=st.integers(0, 3))
def test_only_a_box_that_is_falling_may_be_touched(at: float, box: int) -> None:
    """Shortly after it was lost; any other box, any other time is a collision."""
    hit = Collision(at, "tool", f"box {box}", 80.0, held=False, allowed=False)
    kept = list(undue([hit], {1: 5.0}))
    assert (kept == []) == (box == 1 and 0.0 <= at - 5.0 <= FALLING)


def ran(*ids: str, broken: tuple[str, ...] = (), recoveries: tuple[float, ...] = ()) -> Ran:
    """A run that ended well, but for what is broken."""
    verdict = Verdict(
        ended=True, broken=broken, without_person=True, struck=True, ends=("goes on",)
    )
    return Ran(Piece(ids, 7), verdict, recoveries=recoveries)


def test_a_run_that_breaks_something_or_never_ends_is_counted() -> None:
    """In its row, or among the pairs with the words that run it again."""
    endless = Ran(Piece(("G1", "M5"), 8), None, "TimeoutError: ")
    runs = [ran("G1"), ran("G1", broken=("I2: two",)), ran("G1", "W3"), endless]
    alone = Row.of("G1", [each for each in runs if each.piece.ids == ("G1",)])
    assert (alone.seeds, alone.invariants, alone.holds) == (2, 0.5, False)
    pairs = Pairs.of(runs)
    assert (pairs.n, pairs.broken) == (2, (endless,))
    assert RecoveryRow.of([ran("G1", recoveries=(1.0, 2.0, 3.0))]).median == 2.0


class Names(Referee):
    """A referee who knows what boxes are, and nothing else."""

    def __init__(self, *products: Gtin) -> None:
        """Of these products, in the order of the stack."""
        self._products = products

    def product(self, index: int) -> Gtin:
        """What a box is."""
        return self._products[index]


WANTED = Request(0.5, gtin=Gtin("a"))
SERVED = Wish(WANTED, served=3.0, box=BoxId("b1"))


@pytest.mark.parametrize(
    ("state", "wish", "said"),
    [
        (RequestState.SERVED, SERVED, []),
        (RequestState.REJECTED, Wish(WANTED), []),
        (RequestState.PENDING, Wish(WANTED), ["has not ended"]),
        (RequestState.REJECTED, SERVED, ["says otherwise"]),
        (RequestState.SERVED, Wish(Request(0.5, gtin=Gtin("b")), 3.0, BoxId("b1")), ["which is a"]),
        (RequestState.SERVED, None, ["is not known to the cell"]),
    ],
)
def test_a_request_that_ends_amiss_is_found(
    state: RequestState, wish: Wish | None, said: list[str]
) -> None:
    """I8: it has ended, once, by what it asked for."""
    request = WANTED if wish is None else wish.request
    kept = [KeptRequest("r", request, state)]
    wishes: Mapping[str, Wish] = {} if wish is None else {"r": wish}
    found = list(wrong_ends(kept, wishes, {BoxId("b1"): 0}, Names(Gtin("a"))))
    assert len(found) == len(said)
    assert all(words in line for words, line in zip(said, found, strict=True))


def test_a_box_serves_one_request() -> None:
    """Two that were served by the same one are found."""
    kept = [KeptRequest(key, WANTED, RequestState.SERVED) for key in ("r", "q")]
    found = list(wrong_ends(kept, {"r": SERVED, "q": SERVED}, {BoxId("b1"): 0}, Names(Gtin("a"))))
    assert found == ["I8: box b1 has served 2 requests"]


def test_another_trolley_is_told_once_and_an_absent_one_is_none() -> None:
    """The one that comes back is the same."""

    class Bays(FakeBays):
        name: str | None = "one"

        def trolley(self, bay: str) -> str | None:
            return self.name if bay == "trolley_1" else f"{bay}'s"

    bays = Bays()
    trolleys = Trolleys(bays, shipped_cell("default").storages)
    seen = []
    for bays.name in ("one", None, "one", "two", "two", None, "one"):
        seen.append(trolleys.exchanged())
    assert seen == [(), (), (), ("trolley_1",), (), (), ("trolley_1",)]


@pytest.fixture
def lying(monkeypatch: pytest.MonkeyPatch) -> None:
    """Books that name another place than the one in which a box stands."""
    ends = Departures.ends

    def wrongly(self: Departures, departure: Departure) -> None:
        ends(self, replace(departure, place=PlaceId("trolley_1/level_3")))

    monkeypatch.setattr(Departures, "ends", wrongly)


@pytest.mark.slow
@pytest.mark.usefixtures("lying")
def test_books_that_are_wrong_end_the_run_at_once() -> None:
    """It is broken off before the second box has ended."""
    outcome = run_job(job_of(Piece(("G1",), 0)))
    assert outcome.broken.startswith("I1")
    assert len(outcome.departures) == 1
    assert list(broken_in(outcome)) == [outcome.broken]


@pytest.mark.slow
def test_a_stop_that_nobody_answers_and_the_arm_goes_on_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """An arm that moves while the question stands open breaks I7."""
    monkeypatch.setattr("depal.cell.halting.HaltingArm._freed", _at_once)
    outcome = run(THREE, faults=FaultPlan((Fault("M5"),)))
    assert outcome.broken.startswith("I5, I7: the arm moves before stopped/1 is answered")


@pytest.mark.slow
def test_a_stop_counts_from_when_it_is_seen() -> None:
    """The arm brakes while the first look after a stop is made: nothing is broken by that."""
    assert not run_job(job_of(Piece(("M7", "M3"), 144))).broken


async def _at_once(*_: object) -> None:
    """Nobody waits."""


@pytest.mark.slow
def test_the_same_seed_gives_the_same_events_three_times() -> None:
    """For a pair of faults, with requests and a referee who looks on."""
    runs = [run_one(Piece(("G4", "M6"), 11)) for _ in range(3)]
    assert len({each.events_sha256 for each in runs}) == 1
    assert all(each.verdict is not None and not each.verdict.broken for each in runs)
    assert all(each.checks > 50 for each in runs)
