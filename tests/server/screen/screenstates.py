"""States of the cell for the tests of its screen."""

from dataclasses import replace

from depal.server.cellstate import CellState, Mode, QueueLine, Solid


def line(box: str, **changes: object) -> QueueLine:
    """A box on the pallet."""
    plain = QueueLine(
        box, None, "", Solid((1.6, 0.0, 0.5), (0.3, 0.4, 0.2), 0.0), 0.4, 0.0, 0.2, "seen", "seen"
    )
    return replace(plain, **changes)  # type: ignore[arg-type]


def state_with(*lines: QueueLine, **changes: object) -> CellState:
    """A cell that works."""
    plain = CellState(
        mode=Mode.EXECUTE, delivery="d", run=1, boxes=12, queue=lines, reason="Boxes are moved."
    )
    return replace(plain, **changes)  # type: ignore[arg-type]
