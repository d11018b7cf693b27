"""Which box next, in the cell: Algorithm 1 over the pile, with grasps that the arm can reach."""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from depal.cell.accessing import ways_in_cell
from depal.cell.apart import standing_apart
from depal.cell.half_seen import may_reach_behind
from depal.cell.identity import ALIKE, beyond_seen, plausible
from depal.cell.laden import is_laden, may_reach_under
from depal.cell.planning.desk import Desk
from depal.cell.planning.facing import pallet_front
from depal.cell.planning.plans import PickPlan
from depal.cell.planning.surroundings import STRANGE
from depal.cell.seeking import searches
from depal.cell.standing import Firmness, left_by, standing_pile
from depal.cell.straddling import goes_on_beside
from depal.cell.workplace import Policy, Workplace
from depal.domain import BoxId, Detection, Perceived, Recognition, Request
from depal.geometry import OrientedBox
from depal.motion.grasping import EXACT
from depal.selection import Blocking, BlockingGraph, Decision, Refused, ScoreRule, select
from depal.selection.access import NO_WAY, AccessGraph
from depal.selection.stability import Watch


@dataclass(frozen=True, slots=True)
class Choice:
    """One selection.

    Attributes:
        decision: with every reason.
        plans: how many motions were planned for it.
        doubts: what speaks against the chosen box, where nothing better was free.
    """

    decision: Decision[PickPlan]
    plans: int
    doubts: str | None = None


def choose(work: Workplace, desk: Desk) -> Choice:
    """One call of BOXSELECTION (section II-C) over what stands on the pallet.

    What there are doubts about stays where it is as long as anything else can be taken: what goes
    first bares more of it.

    Args:
        work: the pile, the requests, the settings.
        desk: asked for a pick of the boxes that nothing blocks, by falling score.

    Returns:
        The choice; its grasp is a planned pick.
    """
    wishes, rule = work.wishes.open(work.now), rule_of(work)
    graph = blocking_of(work, desk, wishes)
    pile = standing_pile(work, graph)
    watch, firmness = Watch(pile), Firmness(work, pile)
    shaky: dict[BoxId, PickPlan] = {}
    before = desk.planner.planned
    waiting: set[BoxId] = set()
    doubtful = False

    def grasp_for(box: Perceived) -> PickPlan | Refused:
        stays = _stays(work, graph, box, firmness)
        if stays is not None:
            return stays
        doubts = why_later(work, box) or _still_refused(work, box)
        if doubts is not None and not doubtful:
            waiting.add(box.id)
            return Refused(doubts)
        plan = shaky.get(box.id) or desk.picking.try_pick(box)
        if isinstance(plan, str):
            work.refusals.keep(box, work.pile, plan)
            return Refused(plan)
        refusal = watch.refusal(box.id) if work.settings.guard else None
        if refusal is not None:
            shaky[box.id] = plan
        return refusal or plan

    decision = select(graph, wishes, rule, grasp_for)
    if decision.target is None and waiting:
        doubtful = True
        decision = select(graph, wishes, rule, grasp_for)
    if decision.target is None and watch.relent(tuple(shaky)) is not None:
        decision = select(graph, wishes, rule, grasp_for)
    chosen, plans = decision.target, desk.planner.planned - before
    if chosen is None:
        return Choice(decision, plans)
    decision = replace(decision, certificate=left_by(pile, chosen.id))
    return Choice(decision, plans, why_later(work, chosen))


def _why_barred(graph: Blocking, box: Perceived) -> str | None:
    """Why no way to a box is free, by the policy that asks for ways; None where one is."""
    barred = isinstance(graph, AccessGraph) and not graph.approaches(box.id)
    return NO_WAY if barred else None


def _stays(work: Workplace, graph: Blocking, box: Perceived, firmness: Firmness) -> Refused | None:
    """Why a box is not to be taken now; None where it may be."""
    reason = why_left(work, box) or _why_barred(graph, box)
    return firmness.refusal(box.id) if reason is None else Refused(reason)


def blocking_of(work: Workplace, desk: Desk, wishes: Sequence[Request]) -> Blocking:
    """Which box blocks which, by the policy: G, or the ways that this tool and arm have."""
    graph = BlockingGraph(standing_apart(work.pile))
    if work.settings.policy is Policy.PAPER:
        return graph
    ways, codes = ways_in_cell(graph, work.layout, desk.kinematics, desk.picking.offered)
    found = searches(work, graph, ways, wishes)
    return AccessGraph(graph, ways, codes, pace=pace_of(work), now=work.now, sought=found)


def pace_of(work: Workplace) -> float:
    """How long one box takes, by what has left so far [s]."""
    left = len(work.pile.taken)
    return work.now / left if left else PACE


PACE = 8.0
"""How long a box takes before one has left [s]; `depal study throughput` measures it."""


def why_left(work: Workplace, box: Perceived) -> str | None:
    """Why a box is not to be taken whatever the arm can do; None where it may be."""
    if box.id in work.left_behind:
        return work.left_behind[box.id]
    if box.id in work.pile.hidden:
        return UNSEEN
    reason = _why_impossible(work, box) or why_vague(work, box)
    if reason is None and work.pile.remembered and work.tries.get(box.id, 0) >= VAIN:
        return f"{TRIED} {VAIN} times"
    return reason


def _why_impossible(work: Workplace, box: Perceived) -> str | None:
    """Why no box of a product can be taken, where a print has told which it is."""
    return work.impossible.get(box.gtin) if isinstance(box, Recognition) else None


def why_vague(work: Workplace, box: Perceived) -> str | None:
    """Why a box that nobody could name may be no box, or two.

    The note knows no such size, it is seen across the seam of two, or cups found no hold on the top
    that was concluded from its front, which then is a part of a longer one: where such a one hangs
    in the hand nobody would know. A sight that is exact sees no two as one: what has an odd size
    there is shown to the reader.
    """
    if not work.pile.remembered or isinstance(box, Recognition):
        return None
    unsized = box.id in work.pile.unsized
    if work.delivery.lines and not plausible(work.delivery, box.shape.size, unsized=unsized):
        return ODD
    if goes_on_beside(box.shape, work.pile.strange) != EXACT:
        return STRADDLES
    return NO_TOP if _is_long(work, box) and work.has_no_such_top(box.id) else None


def _is_long(work: Workplace, box: Perceived) -> bool:
    """Whether it makes a difference which way a box lies."""
    edges = [edge for each in plausible(work.delivery, box.shape.size) for edge in each.size[:2]]
    return bool(edges) and max(edges) - min(box.shape.size[:2]) > ALIKE


def why_later(work: Workplace, box: Perceived) -> str | None:
    """Why a box should wait until nothing better is free; None where it need not."""
    if work.pile.remembered and work.tries.get(box.id):
        return TRIED
    strange = work.pile.strange
    if is_laden(box.shape, strange):
        return LADEN
    if work.pile.remembered and is_half_seen(work, box):
        return HALF_SEEN
    return None if isinstance(box, Recognition) else _why_later_unnamed(work, box, strange)


def _why_later_unnamed(
    work: Workplace, box: Perceived, strange: Collection[OrientedBox]
) -> str | None:
    """The same of a box of which no print tells how large it is."""
    beyond = beyond_seen(work.delivery, box.shape.size)
    if work.pile.remembered and may_reach_under(box.shape, strange, beyond):
        return UNDER
    if box.id in work.pile.unsized:
        return GUESSED
    return FRESH if work.pile.is_fresh(box.id) else None


def _still_refused(work: Workplace, box: Perceived) -> str | None:
    """Why no way led to a box when it was tried last, where nothing near it has changed since."""
    return work.refusals.still(box, work.pile) if work.pile.remembered else None


def is_half_seen(work: Workplace, box: Perceived) -> bool:
    """Whether a box may be a broader one, of which something before it hides the rest."""
    pile, layout = work.pile, work.layout
    named = work.delivery.products.get(box.gtin) if isinstance(box, Recognition) else None
    products = (named,) if named else plausible(work.delivery, box.shape.size)
    return may_reach_behind(
        box.shape,
        {edge for product in products for edge in product.size[:2]},
        pallet_front(layout.pallet),
        [*(other.shape for other in pile.boxes if other.id != box.id), *pile.obstacles],
        [camera.cell_from_camera.translation for camera in layout.cameras],
    )


def may_pass(work: Workplace, box: Perceived, reason: str) -> bool:
    """Whether another look may show that a box can be taken after all, or that it is none.

    Args:
        work: what is believed.
        box: that was refused.
        reason: why; what no box explains may be explained by the next look, and a way that was
            not found may be found by another search, or beside boxes that are named by then.
    """
    vague = why_vague(work, box) is not None
    unclear = vague or box.id in work.pile.hidden or STRANGE in reason or GAVE_UP in reason
    words = set(re.findall(r"\w+", reason)) if work.pile.remembered else set()
    unclear |= any(str(each.id) in words for each in work.pile.boxes if isinstance(each, Detection))
    return box.id not in work.left_behind and unclear


UNSEEN, ODD, STRADDLES, NO_TOP = (
    "the last look did not show it",
    "no product of the note has its size",
    "its surface goes on beside it, and no box explains that",
    "cups found no hold on its top, so how it lies is not sure",
)
"""Reasons that another look may take away."""

GAVE_UP = "no free way"
"""How a motion's reason begins where the search for it has come to its limit."""

LADEN, UNDER, HALF_SEEN, GUESSED, FRESH, TRIED = (
    "something that nobody knows may stand on it",
    "it may go on below something higher that nobody knows",
    "what stands before it may hide a part of it",
    "one of its edges is a guess",
    "only the last look has shown it",
    "it was tried in vain",
)
"""Reasons to take another box first."""

VAIN = 3
"""A box that was tried in vain so often is not as it looks."""


def rule_of(work: Workplace) -> ScoreRule:
    """Eq. (3) for this cell: x_max is the far side of its pallet."""
    stand = work.layout.pallet
    length, width, _ = stand.size
    corners = [(x, y, 0.0) for x in (0.0, length) for y in (0.0, width)]
    x_max = max(stand.cell_from_pallet.apply(corner)[0] for corner in corners)
    return ScoreRule(w=work.settings.w, x_max=x_max)


def priority_of(decision: Decision[PickPlan], box: BoxId) -> float:
    """l(b) of a box, Eq. (2): what its store is worth to the executive."""
    return decision.verdict(box).l
