"""Why nothing goes on in a state."""

from depal.executive.conditions import AllOf, Always, Condition
from depal.executive.exploring.model import Model, View
from depal.executive.exploring.moves import Moves, State
from depal.executive.language import format_condition


def reason(moves: Moves, state: State) -> str:
    """What every part of the tree lacks, from the root down to the first obstacle.

    Args:
        moves: of the model.
        state: one in which nothing goes on.

    Returns:
        Phrases with semicolons between them.
    """
    view = moves.model.view(state.facts)
    return "; ".join(_below(moves, state, view, 0))


def _below(moves: Moves, state: State, view: View, index: int) -> list[str]:
    model = moves.model
    node, standing = model.tree.nodes[index], view.standings[index]
    if standing.post:
        return [f"{node.label} is accomplished"]
    if not (standing.pre and standing.within):
        return [f"{node.label} needs {format_condition(needed(model, index))}"]
    if node.concrete:
        return [_primitive(moves, state, index)]
    return [one for child in node.children for one in _below(moves, state, view, child)] or [
        f"{node.label} has no steps"
    ]


def needed(model: Model, index: int) -> Condition:
    """All that has to hold at a node for it to run, grounded."""
    conditions = model.conditions[index]
    parts = tuple(
        one.condition
        for one in (conditions.edge, conditions.when, conditions.within)
        if not isinstance(one.condition, Always)
    )
    return parts[0] if len(parts) == 1 else AllOf(parts)


def _primitive(moves: Moves, state: State, index: int) -> str:
    place = next(at for at, one in enumerate(moves.model.primitives) if one.node.index == index)
    label = moves.labels[place]
    if place in state.running:
        return f"{label} runs and cannot succeed"
    lacking = moves.claims.missing(place, state.running, state.keepers)
    return f"{label} waits for {lacking}" if lacking else f"{label} has used up its retries"
