"""The state of a cell in which nothing has been started."""

from collections.abc import Sequence
from dataclasses import replace

from depal.domain import CellLayout
from depal.executive.clock import Clock
from depal.server.cell import Settings
from depal.server.cellstate import Alarm, CellState, Mode, TrolleyState


def empty_statement(
    layout: CellLayout,
    before: CellState,
    mode: Mode,
    reason: str,
    alarms: Sequence[Alarm],
    settings: Settings,
    clock: Clock,
) -> CellState:
    """Nothing stands there that anybody knows of."""
    return replace(
        before,
        version=before.version + 1,
        at=clock.now(),
        mode=mode,
        reason=reason,
        alarms=tuple(alarms),
        w=settings.w,
        speed=settings.speed,
        policy=settings.policy,
        joints=tuple(layout.robot.parked),
        trolleys=before.trolleys
        or tuple(
            TrolleyState(
                storage.id,
                present=True,
                boxes=0,
                fill=0.0,
                full=False,
                exchanging=False,
                aside=storage.id == layout.aside,
            )
            for storage in layout.storages
        ),
    )
