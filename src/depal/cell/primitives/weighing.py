"""What hangs on the arm after a lift: the box that was seen, another one, two, or a part of one."""

from collections.abc import Mapping

from depal.cell.breadth import astray, named_astray
from depal.cell.choosing import VAIN
from depal.cell.hand import most_of
from depal.cell.identity import (
    beyond_seen,
    looks_like_two,
    may_be_two,
    plausible,
    size_by_weight,
    weighs_like,
    why_not,
)
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import PickPlan
from depal.cell.primitives.feeling import seals
from depal.cell.workplace import Workplace
from depal.domain import Recognition
from depal.geometry import Vector3
from depal.motion.grasping import EXACT

LIGHT = 0.25
"""Where less than this share of the expected mass hangs on the arm, it holds nothing."""

NOTHING = 0.15
"""Where nobody knows what to expect, less than this is nothing [kg]."""

TORN = 0.9
"""A module whose vacuum falls below this share of what it was has lost a cup's hold."""

TWICE = 2
"""What weighs like two boxes is put back so often; then it is one of another weight."""


class Weighing:
    """Compares what cups and load cell tell with what was seen."""

    def __init__(self, work: Workplace, desk: Desk) -> None:
        """Of the boxes of this cell."""
        self._work = work
        self._desk = desk

    def beyond(self, plan: PickPlan, mass: float) -> Vector3:
        """How much longer the box in the hand may be than it looked; its mass tells more [kg]."""
        work, box, size = self._work, plan.box.id, plan.box.shape.size
        if not work.pile.remembered:
            return EXACT
        if isinstance(plan.box, Recognition):
            pallet, tried = work.layout.pallet.cell_from_pallet, bool(work.tries.get(box))
            return named_astray(plan.box.shape, pallet, tried=tried)
        unsized = box in work.pile.unsized
        return astray(beyond_seen(work.delivery, size, mass), unsized=unsized)

    def torn(self, plan: PickPlan, sealed: Mapping[str, float]) -> str | None:
        """What hangs on some of the cups that had sealed is held beside its middle.

        Args:
            plan: of the box.
            sealed: the vacuum of each module before the lift [Pa].
        """
        if not self._work.pile.remembered:
            return None
        now = self._work.ports.gripper.vacuum()
        if all(now[name] >= TORN * value for name, value in sealed.items()):
            return None
        self.tell_a_seam(plan)
        return "some of the cups have lost their hold"

    def tell_a_seam(self, plan: PickPlan, *, sure: bool = False) -> None:
        """Where some cups seal and others do not, no one face is under all of them.

        Args:
            plan: of the box.
            sure: whether a print does not say otherwise: it may be that of one of two boxes.
        """
        told = isinstance(plan.box, Recognition) and not sure
        if self._work.pile.remembered and not told and seals(self._work):
            self._work.feedback.part(self._desk.feeling.under_cups(plan))

    def wrong_weight(self, plan: PickPlan, mass: float) -> str | None:
        """What hangs on the arm is nothing, too much, or more than one box."""
        work = self._work
        limit = work.layout.robot.payload - work.layout.tool.mass
        if mass > limit:
            return f"{mass:.1f} kg is more than the arm may carry ({limit:.1f} kg)"
        least, most = self._desk.picking.masses(plan.box)
        if mass < (NOTHING if least is None else LIGHT * least):
            return f"{mass:.1f} kg hang on the arm where {plan.mass:.1f} kg were expected"
        if most is not None and mass > most_of(most):
            told = isinstance(plan.box, Recognition)
            size = size_by_weight(work.delivery, plan.box.shape.size, mass)
            if size is not None and not told:
                work.pile.resize(plan.box.id, size)  # it is another product: taken anew as that
            elif self._weighs_like_two(plan, mass):
                self.tell_a_seam(plan, sure=True)
            if size is None and not told:
                work.tries[plan.box.id] = VAIN  # it is two boxes, or part of something else
            return f"{mass:.1f} kg hang on the arm where {most:.1f} kg were the most expected"
        if work.tries.get(plan.box.id, 0) < TWICE and self._weighs_like_two(plan, mass):
            self.tell_a_seam(plan)
            return f"{mass:.1f} kg hang on the arm, which two boxes weigh together"
        return None

    def _weighs_like_two(self, plan: PickPlan, mass: float) -> bool:
        """Whether two boxes may hang on the arm where one was seen: by their weight and size."""
        work, box, size = self._work, plan.box, plan.box.shape.size
        named = work.product_of(box)
        unsized = box.id in work.pile.unsized
        products = (named,) if named else plausible(work.delivery, size, unsized=unsized)
        if may_be_two(products, work.delivery, mass):
            return True
        alone = any(weighs_like(product, mass) for product in products)
        return not alone and work.pile.remembered and looks_like_two(work.delivery, size, mass)

    def doubt_identity(self, plan: PickPlan, mass: float) -> None:
        """A box that the picture has named must weigh what the product does, and be on the note."""
        work, box = self._work, plan.box
        if not isinstance(box, Recognition):
            return
        product = work.delivery.products.get(box.gtin)
        if product is None:
            reasons: tuple[str, ...] = (f"product {box.gtin} is not on the note",)
        else:
            unsized = box.id in work.pile.unsized
            reasons = why_not(product, box.shape.size, mass, unsized=unsized)
            too_many = work.surplus(box.gtin)
            reasons = (*reasons, too_many) if too_many else reasons
        if reasons:
            work.mistrust(box.id, reasons)
            self._desk.promises.release(box.id)
