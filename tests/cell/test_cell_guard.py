"""The guard in the cell: what would leave a shaky pile waits, and the firmest goes where all do."""

from types import SimpleNamespace
from typing import Any, cast

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.planning.plans import PickPlan
from depal.cell.standing import Guard, Standing
from depal.domain import BoxId, Detection
from depal.geometry import OrientedBox
from depal.selection import Refused
from depal.selection.stability import THRESHOLD, Certificate, Proof

SHAPE = OrientedBox.upright((0.0, 0.0, 0.0), (0.3, 0.2, 0.2))


class _Margins:
    """A pile of which the margin without each box is known."""

    def __init__(self, margins: list[float]) -> None:
        self._margins = {BoxId(f"b{k}"): margin for k, margin in enumerate(margins)}

    def without(self, box: BoxId) -> Certificate:
        """As it was given."""
        return Certificate(self._margins[box], Proof.EXACT, (1.0, 0.0), ())


@given(st.lists(st.floats(-0.1, 0.2), min_size=1, max_size=6))
def test_the_guard_passes_what_is_firm_and_else_the_firmest(margins: list[float]) -> None:
    """In the order of the selection."""
    guard = Guard(cast("Standing", _Margins(margins)))
    boxes = [Detection(BoxId(f"b{k}"), SHAPE) for k in range(len(margins))]
    plans = [cast("PickPlan", SimpleNamespace(box=box)) for box in boxes]
    firm = [k for k, margin in enumerate(margins) if margin >= THRESHOLD]
    judged: list[Any] = [guard.judged(*pair) for pair in zip(boxes, plans, strict=True)]
    for k, answer in enumerate(judged):
        assert (answer is plans[k]) == (k in firm)
        assert isinstance(answer, Refused) != (k in firm)
        assert guard.kept(boxes[k]) is (None if k in firm else plans[k])
    shaky = [k for k in range(len(margins)) if k not in firm]
    assert guard.force() == bool(shaky)
    assert not guard.force()
    if shaky:
        best = max(shaky, key=lambda k: margins[k])
        assert guard.judged(boxes[best], plans[best]) is plans[best]
