"""Which primitive does which action of the task files."""

from collections.abc import Mapping

from depal.cell.guards import Guards
from depal.cell.halting import HaltingArm
from depal.cell.planning.desk import Desk
from depal.cell.primitives.bounding import Bounding
from depal.cell.primitives.checking import Checking
from depal.cell.primitives.exchanging import Exchanging
from depal.cell.primitives.leaving import Leaving
from depal.cell.primitives.minding import Minding
from depal.cell.primitives.moving import Moving
from depal.cell.primitives.querying import Querying
from depal.cell.primitives.restarting import Restarting
from depal.cell.primitives.seeing import Seeing
from depal.cell.primitives.taking import Taking
from depal.cell.reporting import Journalist
from depal.cell.workplace import Workplace
from depal.executive.runtime import Primitive


def bindings(
    work: Workplace, desk: Desk, notes: Journalist, arm: HaltingArm | None = None
) -> tuple[Mapping[str, Primitive], Mapping[str, Primitive]]:
    """The primitive of every action, and the probes."""
    guards = Guards(work.ports.arm, work.ports.gripper, work.ports.safety)
    seeing, taking = Seeing(work, desk, notes), Taking(work, desk, guards)
    checking, leaving = Checking(work, desk, guards), Leaving(work, desk, guards)
    querying, exchanging = Querying(work, desk), Exchanging(work, desk)
    minding, moving = Minding(work, desk), Moving(work, desk, guards)
    restarting = Restarting(work, desk, guards, arm)
    primitives: dict[str, Primitive] = {
        "look": seeing.look,
        "select_box": seeing.select_box,
        "await_box": seeing.await_box,
        "kr60_reach": taking.reach,
        "kr60_grasp": taking.grasp,
        "kr60_show": checking.show,
        "read_barcode": checking.read,
        "ask_target": querying.ask_target,
        "kr60_carry": leaving.carry,
        "kr60_release": leaving.release,
        "kr60_bring": leaving.carry,
        "kr60_put": leaving.put,
        "kr60_reach_into": moving.reach_into,
        "inspect_bay": exchanging.inspect,
        "call_for_exchange": exchanging.call,
        "await_trolley": exchanging.await_new,
        "show_question": minding.show_question,
        "await_answer": minding.await_answer,
        "look_again": minding.look_again,
        "ask_decision": minding.ask_decision,
        "ask_to_take": minding.ask_to_take,
        "carry_on": minding.carry_on,
        "ask_for_start": restarting.ask_for_start,
        "check_safety": restarting.check_safety,
        "draw_back": restarting.draw_back,
    }
    bounding = Bounding(work, desk, guards)
    primitives = {name: bounding.wrap(primitive) for name, primitive in primitives.items()}
    probes: dict[str, Primitive] = {"arm": taking.probe_arm, "gripper": taking.probe_gripper}
    return primitives, probes
