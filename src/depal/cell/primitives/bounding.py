"""Every action on the arm: kept within its limits, and clear of where it was asked to stop."""

from dataclasses import replace

from depal.cell.clearing import get_clear
from depal.cell.guards import Guards
from depal.cell.planning.desk import Desk
from depal.cell.primitives.falling import report_loss
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context, Primitive
from depal.executive.schema import Cancel

ARM = "kr60"
"""The resource that moves."""


class Bounding:
    """Wraps the primitives of one cell."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Plans ways out with the desk."""
        self._work, self._desk, self._guards = work, desk, guards
        self._astray = False

    def wrap(self, primitive: Primitive) -> Primitive:
        """The same primitive, bounded where its action uses the arm."""

        async def run(context: Context) -> Report:
            if ARM not in context.action.uses:
                return await primitive(context)
            with self._work.bounds.under(context):
                moves = context.action.cancel is Cancel.AT_CHECKPOINT
                lost = await self._back(context) if moves and self._astray else None
                return lost or self._as_it_was(context, await primitive(context))

        return run

    def _as_it_was(self, context: Context, report: Report) -> Report:
        """A motion that ended because it was asked to has not failed."""
        asked = context.stop_reason is not None and report.reason == context.stop_reason
        if not asked or report.outcome is not Outcome.FAILED:
            return report
        self._astray = True
        self._desk.promises.next_start = None
        return replace(report, outcome=Outcome.CANCELLED)

    async def _back(self, context: Context) -> Report | None:
        """From where a motion was broken off to where plans can begin."""
        held = self._work.held
        lost = await get_clear(
            self._work, self._desk, self._guards.holding() if held is not None else None
        )
        self._astray = False
        if lost is None or held is None:
            return None
        return await report_loss(self._work, BoxId(context.args["Box"]), lost)
