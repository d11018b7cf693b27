"""What is written before and after each step, and what a restart makes of it."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.departures import Departure, Fate
from depal.cell.hand import Hand, Phase, most_of
from depal.cell.ledger import Found, KeptBox, Ledger, LeftBox, Page, PiledBox, Sensed, reconcile
from depal.cell.ledger.reconciling import CARRIED, NOTHING
from depal.cell.wishes import Wish
from depal.domain import Approach, BoxId, Grasp, Gtin, PlaceId, Request
from depal.errors import JournalError
from depal.geometry import OrientedBox, Pose
from depal.logistics.placing import Standing

MASS = 4.0

GRASP = Grasp(
    Approach.VERTICAL,
    folded=False,
    box_from_flange=Pose((0.0, 0.0, 0.2)),
    cups=(("front", 0), ("lower", 3)),
)


def hand(phase: Phase, place: str | None = None) -> Hand:
    """A box of 4 kg in some phase."""
    where = None if place is None else PlaceId(place)
    return Hand(BoxId("b1"), GRASP, (0.3, 0.2, 0.25), MASS, phase, where)


@pytest.mark.parametrize(
    ("phase", "vacuum", "load", "found"),
    [
        (Phase.GRASPING, False, 0.0, Found.NOT_STARTED),  # intent written, no contact yet
        (Phase.GRASPING, True, 0.0, Found.LET_GO),  # vacuum rises, box on the pallet
        (Phase.GRASPING, True, MASS, Found.HOLDING),  # lifted, not yet reported
        (Phase.HELD, True, MASS, Found.HOLDING),  # at the reader, on the way, query sent
        (Phase.HELD, False, 0.0, Found.DROPPED),  # lifted, box lost
        (Phase.LOWERING, True, MASS, Found.HOLDING),  # in the place, above the spot
        (Phase.LOWERING, True, 0.1 * MASS, Found.SET_DOWN),  # stands, vacuum still on
        (Phase.LOWERING, True, 0.4 * MASS, Found.SET_DOWN),  # weight falling
        (Phase.LOWERING, False, 0.0, Found.DROPPED),  # nobody let it go, and it is gone
        (Phase.VENTING, True, 0.4 * MASS, Found.SET_DOWN),  # release begun
        (Phase.VENTING, False, 0.0, Found.PLACED),  # released, before DONE
        (Phase.HELD, True, 0.0, Found.UNKNOWN),  # cups on something that weighs nothing
        (Phase.GRASPING, True, 0.4 * MASS, Found.UNKNOWN),  # half lifted
        (Phase.GRASPING, True, 2 * MASS, Found.LET_GO),  # lifted with a neighbour, not weighed yet
        (Phase.HELD, True, 2 * MASS, Found.UNKNOWN),  # it was alone when it was weighed
    ],
)
def test_the_crash_table(phase: Phase, *, vacuum: bool, load: float, found: Found) -> None:
    """RELIABILITY, the table under "The core protocol": cut point, world, decision."""
    assert reconcile(hand(phase, "trolley_1/level_1"), Sensed(vacuum, load)) is found


@given(phase=st.sampled_from(Phase), vacuum=st.booleans(), load=st.floats(0.0, 3 * MASS))
def test_no_cut_makes_a_box_that_may_hang_on_the_arm_be_forgotten(
    phase: Phase, *, vacuum: bool, load: float
) -> None:
    """Whatever the phase: with its whole mass on the arm it is held, or a person is asked.

    With more than that it is not alone: then it is put back where it stood, as after any lift.
    """
    found = reconcile(hand(phase, "trolley_1/level_1"), Sensed(vacuum, load))
    if load > most_of(MASS):
        assert found in {Found.LET_GO if phase is Phase.GRASPING else Found.UNKNOWN, Found.UNKNOWN}
    elif load >= CARRIED * MASS:
        assert found in {Found.HOLDING, Found.UNKNOWN}
    if found is Found.PLACED:
        assert phase is Phase.VENTING
        assert load < NOTHING * MASS


@pytest.mark.parametrize(
    ("vacuum", "load", "found"),
    [(False, 0.0, Found.NOTHING), (True, 0.0, Found.LET_GO), (True, 2.0, Found.UNKNOWN)],
)
def test_without_a_step_nothing_may_hang_on_the_arm(
    *, vacuum: bool, load: float, found: Found
) -> None:
    """What does nobody knows of."""
    assert reconcile(None, Sensed(vacuum, load)) is found


SOLID = OrientedBox(Pose.from_yaw((1.6, 0.1, 0.4), 0.3), (0.3, 0.2, 0.25))

PAGE = Page(
    hand=hand(Phase.LOWERING, "trolley_1/level_1"),
    left=(LeftBox(BoxId("b2"), 3.5, Gtin("4006381333931")), LeftBox(BoxId("b1"), 9.0, None)),
    departures=(
        Departure(
            BoxId("b2"),
            Gtin("4006381333931"),
            Approach.HORIZONTAL,
            PlaceId("trolley_2/level_1"),
            Fate.STORED,
            "",
            3.5,
        ),
    ),
    kept=(
        KeptBox(
            PlaceId("trolley_2/level_1"),
            Standing(BoxId("b2"), (0.1, 0.0, 0.0), (0.2, 0.3, 0.25), 2.0),
            SOLID,
        ),
    ),
    pile=(PiledBox(BoxId("b3"), SOLID, None),),
    wishes=(Wish(Request(0.4, box=BoxId("b3"), arrived=1.0, due=90.0), key="r-1"),),
    strangers=((BoxId("b9"), "40170725"),),
    aside=((BoxId("b1"), "too heavy"),),
    seen_to=True,
    named=12,
)


def test_a_page_comes_back_as_it_was_written(tmp_path: Path) -> None:
    """Also in another process, and the last one counts."""
    path = tmp_path / "ledger.db"
    with Ledger(path) as ledger:
        assert ledger.read() == Page()
        ledger.write(Page(named=3))
        ledger.write(PAGE)
    with Ledger(path) as again:
        assert again.read() == PAGE


def test_a_ledger_of_another_layout_or_of_something_else_is_refused(tmp_path: Path) -> None:
    """It says which file and what was expected; nothing is guessed."""
    path = tmp_path / "ledger.db"
    with Ledger(path) as ledger:
        ledger.write(PAGE)
        ledger._connection.execute("UPDATE page SET layout = 99")  # noqa: SLF001 - a newer depal
        with pytest.raises(JournalError, match="layout 99; expected 1"):
            ledger.read()
        ledger._connection.execute("UPDATE page SET layout = 1, body = x'7b'")  # noqa: SLF001
        with pytest.raises(JournalError, match="cannot be read"):
            ledger.read()
    other = tmp_path / "other.db"
    other.write_text("this is no database, it is a letter to somebody", encoding="utf-8")
    with pytest.raises(JournalError, match=r"other\.db: the ledger cannot be opened"):
        Ledger(other)
