"""A controller over the ports of a cell, wired: what a run and a served cell have in common."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from depal.cell.bookkeeping import Bookkeeping, WrittenArm, WrittenGripper
from depal.cell.controller import Controller
from depal.cell.feedback import Feedback
from depal.cell.halting import HaltingArm
from depal.cell.planning.desk import Desk, MotionDesk
from depal.cell.planning.planner import Planner
from depal.cell.questions import Questions
from depal.cell.reporting import Journalist
from depal.cell.safety import CautiousArm
from depal.cell.sight import CameraSight
from depal.cell.sight.fresh import FreshSight
from depal.cell.timekeeping import Timekeeper, timed
from depal.cell.workplace import Ports, Settings, Workplace
from depal.domain import CellLayout, Delivery, Gtin
from depal.executive.engine import Engine
from depal.executive.journal import Journal
from depal.executive.schema import Repository


@dataclass(frozen=True, slots=True)
class Wiring:
    """What a controller is wired from.

    Attributes:
        layout: the cell.
        told: the note.
        settings: how the run is to go.
        tasks: what the cell can do.
        journal: written before anything is done.
        seed: of the planner's samples.
        impossible: products that the arm cannot handle, and why.
        cone: whether motions respect the suction's limits.
        engine: folded from the journal after a restart; None at a beginning.
    """

    layout: CellLayout
    told: Delivery
    settings: Settings
    tasks: Repository
    journal: Journal
    seed: int = 0
    impossible: Mapping[Gtin, str] = field(default_factory=dict)
    cone: bool = True
    engine: Engine | None = None


@dataclass(frozen=True, slots=True)
class Assembly:
    """A wired controller.

    Attributes:
        work: what the cell believes.
        desk: plans its motions.
        notes: tells what happens.
        controller: of it all.
        times: where the time goes.
    """

    work: Workplace
    desk: Desk
    notes: Journalist
    controller: Controller
    times: Timekeeper


DeskOf = Callable[[Wiring, Workplace, Timekeeper], Desk]
"""Makes what plans the motions."""


def motion_desk(wiring: Wiring, work: Workplace, times: Timekeeper) -> Desk:
    """The desk that plans for a real arm."""
    stopwatch = time.perf_counter
    planner = Planner(work, times, cone=wiring.cone, seed=wiring.seed, stopwatch=stopwatch)
    return MotionDesk(work, planner)


def assemble(wiring: Wiring, ports: Ports, desk_of: DeskOf = motion_desk) -> Assembly:
    """Wires a controller to the ports of a cell.

    Args:
        wiring: what it is wired from.
        ports: of the cell.
        desk_of: makes its planning desk.
    """
    times = Timekeeper(ports.clock)
    sight = ports.sight
    ports = timed(ports, times)
    halting = HaltingArm(CautiousArm(ports.arm, ports.safety, ports.clock, times))
    questions = Questions(ports.person, ports.clock)
    books = Bookkeeping(questions)
    ports = replace(
        ports,
        arm=WrittenArm(halting, books),
        gripper=WrittenGripper(ports.gripper, books),
        sight=FreshSight(ports.sight, ports.clock),
    )
    work = Workplace(
        wiring.layout, wiring.told, ports, wiring.settings, questions, wiring.impossible
    )
    desk = desk_of(wiring, work, times)
    halting.bind(work)
    if isinstance(sight, CameraSight):
        sight.bind(work.pile, desk.viewing.covered)
        work.feedback = Feedback(sight.learn, sight.doubt, sight.deny, sight.part)
    notes = Journalist()
    controller = Controller(
        work, desk, notes, wiring.tasks, wiring.journal, wiring.engine, books, halting
    )
    return Assembly(work, desk, notes, controller, times)
