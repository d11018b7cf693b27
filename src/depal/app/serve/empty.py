"""The state of a cell in which nothing has been started."""

from collections.abc import Sequence
from dataclasses import replace

from depal.domain import CellLayout
from depal.executive.clock import Clock
from depal.server.cell import Order, Settings
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
        CellState(),
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


def begun_statement(empty: CellState, order: Order) -> CellState:
    """A delivery that is being started: nothing of it was seen yet."""
    return replace(
        CellState(),
        version=empty.version,
        at=empty.at,
        mode=Mode.EXECUTE,
        reason="The cell looks at the pallet for the first time.",
        delivery=order.delivery.id,
        run=order.run,
        boxes=sum(line.count for line in order.delivery.lines),
        w=empty.w,
        speed=empty.speed,
        policy=empty.policy,
        joints=empty.joints,
        trolleys=empty.trolleys,
    )
