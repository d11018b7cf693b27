"""What the arm keeps out of: boxes, what carries them, and what only a depth picture shows."""

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.cell.pile import Pile
from depal.cell.planning.surroundings import THIN, Surroundings
from depal.geometry import OrientedBox
from depal.ports import View

CELL = shipped_cell("default")
DECK = CELL.pallet.cell_from_pallet.translation[2]


@given(st.floats(DECK + THIN + 0.03, 1.5))
def test_nothing_is_below_what_stands_there_but_what_carries_it(height: float) -> None:
    """A top that no box explains is an obstacle from the deck up: nothing moves under it."""
    plate = OrientedBox.upright((1.6, 0.1, height), (0.2, 0.2, 0.02))
    pile = Pile()
    pile.see(View(0.0, (), remembered=True, obstacles=(plate,)))
    before = Surroundings(CELL).scene(Pile()).names
    added = [name for name in Surroundings(CELL).scene(pile).names if name not in before]
    assert len(added) == 2
    pile.see(View(1.0, (), remembered=True, obstacles=()))
    assert Surroundings(CELL).scene(pile).names == before
