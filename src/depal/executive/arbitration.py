"""Winner takes all: which of the waiting primitives start, and which running ones give way."""

from typing import NamedTuple

from depal.executive.emphasis import EmphasisWeights, resting_emphasis
from depal.executive.holdings import Holdings
from depal.executive.nodes import Attempt, LiveNode
from depal.executive.schema import Cancel
from depal.executive.waiting import Waiting


class Verdict(NamedTuple):
    """What one look at everybody decides: one node to start, or attempts to break off.

    Attributes:
        start: the node to start.
        contested: whether somebody waits for what another uses, so that time alone may decide.
        displace: the attempts to break off, and for whom.
    """

    start: LiveNode | None = None
    contested: bool = False
    displace: tuple[tuple[Attempt, LiveNode], ...] = ()


NOTHING = Verdict()


def arbitrate(
    waiting: Waiting,
    holdings: Holdings,
    attempts: dict[int, Attempt],
    weights: EmphasisWeights,
    now: float,
) -> Verdict:
    """Decides about the best waiting primitive that can be decided about.

    Claims are all or nothing. A primitive that waits for one of its resources reserves the
    others against those with less emphasis, so that many small claims cannot starve a large
    one; what waits for a kept resource reserves nothing, for its keeper may need the rest.

    Args:
        waiting: who may run and does not.
        holdings: who uses and keeps what.
        attempts: what runs.
        weights: of the emphasis.
        now: the time [s].

    Returns:
        The node to start (call again afterwards), or whom it should displace, or nothing.
    """
    candidates = _candidates(waiting, holdings)
    if not candidates:
        return NOTHING
    reserved: set[str] = set()
    displaced: list[tuple[Attempt, LiveNode]] = []
    for node in candidates:
        claim = node.action.uses
        if any(holdings.is_kept_from(node, name) for name in claim):
            continue
        busy = [name for name in claim if not holdings.is_free_for(node, name)]
        if not busy and (
            reserved.isdisjoint(claim)
            or any(holdings.keeper_above(node, name) is not None for name in claim)
        ):
            return Verdict(start=node)
        for name in busy:
            holder = _displaceable(node, name, holdings, attempts, weights, now)
            if holder is not None:
                displaced.append((holder, node))
        reserved.update(claim)
    return Verdict(contested=bool(reserved), displace=tuple(displaced))


def _candidates(waiting: Waiting, holdings: Holdings) -> list[LiveNode]:
    """The first of every claim, and everybody inside a keeper; best first, in a total order."""
    found = waiting.firsts(holdings.closed)
    for keeper in holdings.keepers:
        for node in waiting.of_tree(keeper.tree.number):
            if node.is_within(keeper):
                found.append((-node.rank, node.place, node))
    if len(found) < 2:  # noqa: PLR2004 - nothing to choose
        return [node for _, _, node in found]
    found.sort(key=_order)
    return list({place: node for _, place, node in found}.values())


def _order(candidate: tuple[float, tuple[int, int], LiveNode]) -> tuple[float, tuple[int, int]]:
    return candidate[0], candidate[1]


def _displaceable(
    challenger: LiveNode,
    resource: str,
    holdings: Holdings,
    attempts: dict[int, Attempt],
    weights: EmphasisWeights,
    now: float,
) -> Attempt | None:
    """The weakest user of a resource that the challenger exceeds by the margin, if any may go."""
    age = weights.age * (now - challenger.waiting_since)
    strength = resting_emphasis(challenger, weights) + age
    if any(attempts[number].cancel is not None for number in holdings.users(resource)):
        return None  # a unit is on its way
    users = [
        (resting_emphasis(user, weights), number)
        for number, user in holdings.users(resource).items()
        if user.action.cancel is not Cancel.NEVER
        and holdings.keeper_above(user, resource) is holdings.keeper_above(challenger, resource)
    ]
    for emphasis, number in sorted(users):
        attempt = attempts[number]
        if strength > emphasis + weights.margin:
            return attempt
    return None
