"""The state as text, so that a restart need not fold the whole journal."""

import json
from typing import Any

import msgspec

from depal.errors import JournalError
from depal.executive import events as ev
from depal.executive.emphasis import EmphasisWeights, rank
from depal.executive.nodes import Attempt, LiveNode
from depal.executive.schema import Repository
from depal.executive.state import State


def freeze(state: State) -> str:
    """The state as canonical JSON; `thaw` gives it back."""
    body = {
        "digest": state.repository.digest,
        "now": state.now,
        "held": state.held,
        "next_tree": state.next_tree,
        "next_attempt": state.next_attempt,
        "facts": state.facts,
        "changed_at": state.changed_at,
        "trees": [
            {
                "number": tree.number,
                "schema": tree.root.node.schema.name,
                "args": tree.root.node.args,
                "priority": tree.priority,
                "digest": tree.digest,
                "withdrawn": tree.withdrawn,
                "nodes": [
                    [n.node.index, n.failures, n.retry_at, n.faulted, n.waiting_since]
                    for n in tree.nodes
                    if n.failures or n.retry_at or n.faulted or state.waiting.waits(n)
                ],
            }
            for tree in state.trees.values()
        ],
        "attempts": [
            [a.number, *a.node.place, a.started, a.deadline, a.cancel, a.in_doubt]
            for a in state.attempts.values()
        ],
        "keepers": [[name, *node.place] for name, node in state.holdings.kept()],
        "since": state.spans.since(),
    }
    return _written(body)


def thaw(repository: Repository, weights: EmphasisWeights, text: str) -> State:
    """The state that a snapshot holds.

    Raises:
        JournalError: it was made with other task files, or by another version.
    """
    try:
        body = _read(text)
        if body["digest"] != repository.digest:
            message = (
                f"the snapshot was made with other task files ({body['digest']}, now "
                f"{repository.digest}); expected the files that the journal was written with"
            )
            raise JournalError(message)
        state = State(repository, weights)
        state.now = body["now"]
        state.facts.update(body["facts"])
        state.changed_at.update(body["changed_at"])
        state.spans.preset(body["since"])
        for tree in body["trees"]:
            _plant(state, tree)
        for number, tree, node, started, deadline, cancel, in_doubt in body["attempts"]:
            at = state.trees[tree].nodes[node]
            _adopt(state, Attempt(number, at, started, deadline, cancel, in_doubt))
        for name, tree, node in body["keepers"]:
            state.holdings.keep(name, state.trees[tree].nodes[node])
        state.held, state.next_tree = body["held"], body["next_tree"]
        state.next_attempt = body["next_attempt"]
        state.touched.clear()
        state.spans.preset({})
    except (ValueError, KeyError, TypeError, IndexError) as error:
        message = f"the snapshot is of another version: {type(error).__name__}: {error}"
        raise JournalError(message) from error
    return state


def _written(body: dict[str, Any]) -> str:
    try:
        return msgspec.json.encode(body, order="deterministic").decode()
    except UnicodeEncodeError:  # half of a surrogate pair in a text is allowed in JSON
        return json.dumps(body, separators=(",", ":"), sort_keys=True, allow_nan=False)


def _read(text: str) -> dict[str, Any]:
    try:
        body: dict[str, Any] = msgspec.json.decode(text)
    except msgspec.DecodeError:
        body = json.loads(text)  # the same
    return body


def _plant(state: State, tree: dict[str, Any]) -> None:
    state.apply(
        ev.Allocated(
            state.now,
            tree["number"],
            tree["schema"],
            tuple(tree["args"]),
            tree["priority"],
            tree["digest"],
        )
    )
    planted = state.trees[tree["number"]]
    for index, failures, retry_at, faulted, since in tree["nodes"]:
        node: LiveNode = planted.nodes[index]
        node.failures, node.retry_at = failures, retry_at
        _recall(state, node, since, faulted=faulted)
    if tree["withdrawn"] is not None:
        state.apply(ev.Withdrawn(state.now, planted.number, tree["withdrawn"]))


def _recall(state: State, node: LiveNode, since: float, *, faulted: bool) -> None:
    """A node waits again as it did, or for its fault to be cleared."""
    state.waiting.drop(node)
    if faulted:
        state.faults.add(node)
    elif node.gate:
        state.wait(node)
    node.waiting_since = since
    if state.waiting.waits(node):
        state.waiting.put(node, rank(node, state.weights))


def _adopt(state: State, attempt: Attempt) -> None:
    """Gives a node back the attempt that ran."""
    node = attempt.node
    state.waiting.drop(node)
    state.attempts[attempt.number] = attempt
    node.attempt = attempt.number
    node.tree.running[attempt.number] = node
    state.holdings.use(attempt.number, node)
    if attempt.deadline is not None:
        state.set_deadline(attempt, attempt.deadline)
