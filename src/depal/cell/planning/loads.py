"""A box as the next motion will find it, and what boxes weigh."""

import math

import numpy as np

from depal.cell.identity import plausible, weighs_like, why_not
from depal.cell.planning.plans import Load, PickPlan
from depal.cell.planning.timing import stands_at
from depal.cell.workplace import Held, Workplace
from depal.domain import BoxId, Delivery, Perceived, Recognition
from depal.geometry import Vector3
from depal.motion.grasping import EXACT

WARY, UNSURE = 0.6, 0.35
"""Shares of the speed at which boxes move that no print has named, and those of which nobody knows
where their middle is; what accelerates them is about a third and an eighth."""

LOOSE = 0.04
"""Nobody knows where the middle is of a box that may be longer by more than this [m]."""

CLOSE = 0.01
"""And everybody does of one whose product a print or a code has told, where it may reach no farther
than this beyond where it seems to [m]."""

HEAVIEST = 600.0
"""An unknown box is not expected to be denser than this [kg/m^3]."""


def load_of(box: BoxId, work: Workplace, plan: PickPlan | None) -> Load | None:
    """A box that is in the hand now, or will be after its pick; None for any other.

    Args:
        box: which.
        work: what is held, and where the arm stands.
        plan: its pick, where there is one.
    """
    held = work.held
    if held is not None and held.box == box:
        here = np.array(work.ports.arm.joints())
        lifted = plan is not None and stands_at(here, plan.pick.lift.path[-1])
        lead, start = ((plan.pick.out,), plan.pick.out.path[-1]) if plan and lifted else ((), here)
        pace = pace_of(held, work)
        mass = _felt(held, work)
        return Load(box, held.grasp, held.size, mass, lead, start, held.beyond, pace=pace)
    if plan is None:
        return None
    out = plan.pick.out
    size = plan.box.shape.size
    return Load(box, plan.grasp, size, plan.mass, (out,), out.path[-1], plan.beyond)


def pace_of(held: Held, work: Workplace) -> float:
    """The share of the speed at which a held box may move, by how well it is known how it hangs."""
    if not hangs_as_thought(held, work):
        return UNSURE
    told = work.product_of(held.box) is not None and max(held.beyond) <= CLOSE
    return 1.0 if told or held.beyond == EXACT else WARY


def hangs_as_thought(held: Held, work: Workplace) -> bool:
    """Whether a held box can be what it was taken for, so that its middle is where it should be.

    One that weighs like no product of its size is another box, or only a part of one was seen;
    so it may be where a longer product weighs the same, and where cups found no hold before: at the
    same face.
    """
    delivery = work.delivery
    if not (work.pile.remembered and delivery.lines):
        return True
    failed = work.doubted.get(held.box, frozenset())
    vain = work.tries.get(held.box) and (not failed or held.grasp.approach in failed)
    if max(held.beyond[:2]) > LOOSE or vain:
        return False
    product = work.product_of(held.box)
    if product is not None:
        return not why_not(product, held.size, held.mass)
    return any(weighs_like(each, held.mass) for each in plausible(delivery, held.size))


def _felt(held: Held, work: Workplace) -> float:
    """What a held box weighs: what its product should, or what the arm feels [kg]."""
    product = work.product_of(held.box)
    return max(held.mass, product.mass if product else 0.0)


def expected_mass(box: Perceived, delivery: Delivery) -> float:
    """What a box should weigh: its product, or the heaviest of the note of its size [kg]."""
    _, most = expected_masses(box, delivery)
    return heaviest(box.shape.size) if most is None else most


def expected_masses(box: Perceived, delivery: Delivery) -> tuple[float, float] | tuple[None, None]:
    """The least and the most that a box can weigh, by what it is or by its size [kg]."""
    products = delivery.products
    if isinstance(box, Recognition) and box.gtin in products:
        mass = products[box.gtin].mass
        return mass, mass
    masses = [product.mass for product in plausible(delivery, box.shape.size)]
    return (min(masses), max(masses)) if masses else (None, None)


def heaviest(size: Vector3) -> float:
    """What a box of a size weighs at the most [kg]."""
    return HEAVIEST * math.prod(size)
