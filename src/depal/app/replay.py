"""`depal replay`: a recorded run, decision by decision."""

from pathlib import Path

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.errors import JournalError, did_you_mean
from depal.executive import events as ev
from depal.executive.drawing import tree_mermaid, tree_svg, tree_text
from depal.executive.events import Event, encode
from depal.executive.record import Recording
from depal.executive.state import State
from depal.executive.tree import Tree
from depal.executive.why import why

FORMS = ("text", "svg", "mermaid")


def replay_report(folder: Path, *, every: bool) -> Report:
    """The events of a record in words, and whether they would be decided again.

    Args:
        folder: of the record.
        every: all events, or those alone that start, end or fail something.

    Returns:
        The report; it holds when every decision is the recorded one.

    Raises:
        JournalError: there is no record, or it is damaged.
    """
    recording = Recording.read(folder)
    deviations = list(recording.deviations())
    title = f"{folder}: {len(recording.events)} events"
    table = plain_table(title, "", "time [s]", "what happened")
    table.columns[2].justify = "left"
    fields: list[Json] = []
    labels = _labels(recording)
    for number, event in enumerate(recording.events, start=1):
        said = said_of(event, labels)
        fields.append({"sequence": number, "at": event.at, "event": said})
        if every or not isinstance(event, ev.Changed | ev.Ticked):
            table.row(str(number), f"{event.at:.1f}", said)
    shown: list[RenderableType] = [table]
    if deviations:
        text = f"event {deviations[0]} would be decided otherwise today"
        shown.append(Text(text, style="red"))
    else:
        shown.append("Every decision is made again as recorded.")
    return Report(
        fields={"events": fields, "deviations": [*deviations]}, shown=shown, holds=not deviations
    )


def tree_at(folder: Path, sequence: int | None, tree: int | None, form: str) -> str:
    """A tree as it stood after an event.

    Args:
        folder: of the record.
        sequence: the event's number; None for the last.
        tree: the tree's number; None for the first that stood then.
        form: one of FORMS.

    Returns:
        The drawing as text, with the reasons of its disabled nodes where it is text.

    Raises:
        JournalError: no such record, event or tree.
    """
    recording = Recording.read(folder)
    number = len(recording.events) if sequence is None else sequence
    state = recording.state_at(number)
    if tree is None:
        tree = next(iter(state.trees), None)
    if tree is None or tree not in state.trees:
        exists = did_you_mean(str(tree), map(str, state.trees))
        named = "no tree" if tree is None else f"no tree {tree}"
        message = f"{named} stands after event {number}; {exists}"
        raise JournalError(message)
    return drawn(state, tree, form, f"after event {number}, {state.now:.1f} s")


def drawn(state: State, number: int, form: str, title: str) -> str:
    """A tree of a state in one of FORMS."""
    live = state.trees[number]
    plain = Tree(tuple(node.node for node in live.nodes))
    standings = state.standings(live)
    if form == "svg":
        return tree_svg(plain, standings, title)
    if form == "mermaid":
        return tree_mermaid(plain, standings)
    reasons = [why(state, live, index).text for index in range(len(live.nodes))]
    disabled = [text for text in reasons if " is disabled" in text]
    return "\n".join([title, tree_text(plain, standings), *disabled])


def _labels(recording: Recording) -> dict[int, str]:
    """What each attempt runs, by its number."""
    labels: dict[int, str] = {}
    state = recording.state_at(0)
    for event in recording.events:
        state.apply(event)
        if isinstance(event, ev.Started):
            labels[event.attempt] = state.trees[event.tree].nodes[event.node].node.label
    return labels


def said_of(event: Event, labels: dict[int, str]) -> str:  # noqa: PLR0911 - one a kind
    """An event in words."""
    match event:
        case ev.Allocated(tree=tree, schema=schema, args=args, priority=priority):
            return f"tree {tree}: {schema}({', '.join(args)}) allocated, priority {priority:g}"
        case ev.Started(attempt=attempt):
            return f"{labels[attempt]} starts (attempt {attempt})"
        case ev.Ended(attempt=attempt, outcome=outcome, facts=facts, reason=reason):
            changes = ", ".join(f"{key} = {value}" for key, value in facts)
            parts = [part for part in (reason, changes) if part]
            end = f": {'; '.join(parts)}" if parts else ""
            return f"{labels[attempt]} {outcome.value}{end}"
        case ev.CancelAsked(attempt=attempt, reason=reason):
            return f"{labels[attempt]} is to stop: {reason}"
        case ev.Archived(tree=tree, accomplished=accomplished):
            return f"tree {tree} {'accomplished' if accomplished else 'withdrawn'}"
        case ev.Changed(facts=facts, source=source):
            return f"{source}: " + ", ".join(f"{key} = {value}" for key, value in facts)
        case ev.ModeChanged(held=held, source=source):
            return f"{'held' if held else 'started'} by {source}"
        case _:
            return f"{type(event).__name__} {encode(event)}"
