"""Why a node does not run: what is false on its branch, and since when."""

from dataclasses import dataclass

from depal.executive.conditions import (
    AllOf,
    Always,
    AnyOf,
    Binding,
    Compare,
    Condition,
    FactRef,
    Holds,
    Key,
    Lasting,
    Not,
    Value,
    holds,
    is_set,
    key_of,
)
from depal.executive.nodes import LiveNode, LiveTree
from depal.executive.state import State
from depal.executive.tree import NodeState, state_of


@dataclass(frozen=True, slots=True)
class Culprit:
    """One fact that stands in the way.

    Attributes:
        key: the fact.
        value: what it is.
        wanted: what would help: "set", "not set", "= reader", "unchanged for 2 s longer".
        since: since when it is so [s]; None where it has never been set.
        at: the node whose precondition it is part of.
    """

    key: Key
    value: Value
    wanted: str
    since: float | None
    at: str


@dataclass(frozen=True, slots=True)
class Why:
    """The state of a node and what it comes from.

    Attributes:
        node: its label.
        state: what is shown.
        culprits: for a disabled node, facts that would enable it if all of them changed; empty
            for the others.
        text: all of it in a sentence.
    """

    node: str
    state: NodeState
    culprits: tuple[Culprit, ...]
    text: str


def why(state: State, tree: LiveTree, index: int) -> Why:
    """Explains a node of an allocated tree.

    Args:
        state: the executive's state.
        tree: the tree.
        index: of the node.

    Returns:
        The explanation. A disabled node becomes enabled when every culprit becomes as wanted.
    """
    node = tree.nodes[index]
    standing = state.standings(tree)[index]
    shown = state_of(live=standing.live, post=standing.post)
    label = node.node.label
    if shown is NodeState.ACCOMPLISHED:
        return Why(label, shown, (), f"{label} is accomplished")
    if shown is NodeState.ENABLED:
        return Why(label, shown, (), f"{label} is enabled{_waiting(state, node)}")
    culprits = tuple(_along_the_branch(state, node))
    parts = "; ".join(
        f"{culprit.key} is {_said(culprit.value)}{_since(culprit.since)}, "
        f"{culprit.at} wants it {culprit.wanted}"
        for culprit in culprits
    )
    return Why(label, shown, culprits, f"{label} is disabled: {parts}")


def _along_the_branch(state: State, node: LiveNode) -> list[Culprit]:
    found: list[Culprit] = []
    here: LiveNode | None = node
    while here is not None:
        plain = here.node
        above = here.parent.node.label if here.parent else plain.label
        _blame(state, plain.edge, plain.edge_binding, f"{plain.label} in {above}", found)
        _blame(state, plain.schema.when, plain.binding, plain.label, found)
        _blame(state, plain.schema.within, plain.binding, f"within of {plain.label}", found)
        here = here.parent
    return found


def _blame(
    state: State, condition: Condition, binding: Binding, at: str, found: list[Culprit]
) -> None:
    """Adds what makes a condition false; nothing where it holds."""
    if holds(condition, state.facts, binding, state.spans.has_lasted):
        return
    _wish(state, condition, binding, at, found, wanted=True)


def _wish(
    state: State,
    condition: Condition,
    binding: Binding,
    at: str,
    found: list[Culprit],
    *,
    wanted: bool,
) -> None:
    """Adds the changes that give a condition the wanted value, where it has the other one."""
    if holds(condition, state.facts, binding, state.spans.has_lasted) == wanted:
        return
    match condition:
        case Always():
            return
        case Not(part):
            _wish(state, part, binding, at, found, wanted=not wanted)
        case AllOf(parts) | AnyOf(parts):
            # All of a conjunction must change; of a disjunction the first is enough.
            every = isinstance(condition, AllOf) == wanted
            for part in parts if every else parts[:1]:
                _wish(state, part, binding, at, found, wanted=wanted)
        case Lasting(part, seconds):
            if holds(part, state.facts, binding, state.spans.has_lasted) and wanted:
                facts = _first_key(part, binding)
                value = state.facts.get(facts)
                since = state.changed_at.get(facts)
                found.append(Culprit(facts, value, f"so for {seconds:g} s", since, at))
            else:
                _wish(state, part, binding, at, found, wanted=wanted)
        case Holds(fact):
            key = key_of(fact, binding)
            found.append(_culprit(state, key, "set" if wanted else "not set", at))
        case Compare(fact, op, other):
            right = f"{_side(state, other, binding)}"
            verb = op if wanted else f"not {op}"
            found.append(_culprit(state, key_of(fact, binding), f"{verb} {right}", at))


def _culprit(state: State, key: Key, wanted: str, at: str) -> Culprit:
    return Culprit(key, state.facts.get(key), wanted, state.changed_at.get(key), at)


def _side(state: State, other: object, binding: Binding) -> str:
    if isinstance(other, FactRef):
        key = key_of(other, binding)
        return f"{key} ({_said(state.facts.get(key))})"
    return str(getattr(other, "value", None) or binding[getattr(other, "name", "")])


def _first_key(condition: Condition, binding: Binding) -> Key:
    match condition:
        case Holds(fact) | Compare(fact, _, _):
            return key_of(fact, binding)
        case Not(part) | Lasting(part, _):
            return _first_key(part, binding)
        case AllOf(parts) | AnyOf(parts):
            return _first_key(parts[0], binding)
        case _:
            return ""


def _waiting(state: State, node: LiveNode) -> str:
    """What an enabled node waits for."""
    if not node.gate:
        return ", but its task is accomplished"
    if not node.node.concrete:
        return ""
    if node.attempt is not None:
        return f" and runs (attempt {node.attempt})"
    if node.faulted:
        return f", but has failed {node.failures} times: it waits for its fault to be cleared"
    if node.retry_at > state.now:
        return f", but has failed and is tried again at {node.retry_at:g} s"
    return ", but the executive is held" if state.held else _contended(state, node)


def _contended(state: State, node: LiveNode) -> str:
    """Who has what the node needs."""
    blocked = [
        f"{name} ({', '.join(user.node.label for user in state.holdings.users(name).values())})"
        for name in node.action.uses
        if state.holdings.users(name)
    ]
    blocked += [
        f"{name} (kept by {keeper.node.label})"
        for name, keeper in state.holdings.kept()
        if name in node.action.uses and not node.is_within(keeper)
    ]
    return f", and waits for {'; '.join(blocked)}" if blocked else ""


def _said(value: Value) -> str:
    if not is_set(value):
        return "not set"
    return "set" if value is True else str(value)


def _since(at: float | None) -> str:
    return "" if at is None else f" since {at:g} s"
