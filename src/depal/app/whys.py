"""`depal replay RECORD --why`: the choices of a recorded run, explained."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.app.run.record import CHOICES, said
from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition, Request
from depal.errors import InputError, JournalError, did_you_mean
from depal.geometry import OrientedBox
from depal.selection import (
    BlockingGraph,
    Change,
    Decision,
    Explanation,
    Fate,
    LeafAlone,
    Parts,
    PositionWeights,
    Refused,
    ScoreRule,
    explain,
    select,
)
from depal.selection.counterfactuals import Kind, Side

ALL = "all"
"""Asks for every choice, a line each."""

Note = dict[str, Any]
"""A choice as the record has it."""


def why_report(folder: Path, what: str) -> Report:
    """Why boxes were chosen, or not.

    Args:
        folder: of the record.
        what: "all", the number of a choice from 1 on, or a box's name.

    Raises:
        JournalError: there is no such record, choice or box.
    """
    notes = _read(folder)
    if what == ALL:
        return _overview(notes)
    names = sorted({line["box"] for note in notes for line in note["lines"]})
    if what in names:
        return _about(notes, BoxId(what))
    if what.isdigit():
        if not 1 <= int(what) <= len(notes):
            raise JournalError(f"{folder}: there is no choice {what}; it has 1 .. {len(notes)}")
        return _step(notes, int(what))
    raise JournalError(f"{folder}: no choice and no box {what!r}; {did_you_mean(what, names)}")


def _read(folder: Path) -> list[Note]:
    path = folder / CHOICES
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        notes: list[Note] = [json.loads(line) for line in lines]
    except OSError as error:
        message = f"{path}: cannot be read: {error.strerror}; expected a record of `depal run`"
        raise JournalError(message) from None
    except ValueError:
        raise JournalError(f"{path}: is no record's list of choices") from None
    if any("by_score" not in note for note in notes):
        message = f"{path}: has no explanations; expected a record of this version"
        raise JournalError(message)
    return notes


def _overview(notes: list[Note]) -> Report:
    """One line for each choice."""
    table = plain_table(f"{len(notes)} choices", "", "time [s]", "box", "why", "what would turn it")
    for column in table.columns[2:]:
        column.justify = "left"
    fields: list[Json] = []
    for number, note in enumerate(notes, start=1):
        told = recorded(note)
        fields.append(_fields(number, note, told))
        if told is None:
            table.row(str(number), f"{note['at']:.1f}", "-", note["outcome"], "")
            continue
        parts = told.parts
        pull = f"wanted: {parts.pulled_by}" if parts.pulled_by else "by its place"
        lead = f", {told.lead:.3f} above {told.rival}" if told.rival else ""
        turn = told.changes[0].text if told.changes else ""
        table.row(str(number), f"{note['at']:.1f}", str(told.box), f"{pull}{lead}", turn)
    return Report({"choices": fields}, [table])


def _step(notes: list[Note], number: int) -> Report:
    """One choice, and the fate of every box in it."""
    note = notes[number - 1]
    told = recorded(note)
    lines = [note["outcome"]] if told is None else list(told.lines)
    table = plain_table("Every box in this choice", "box", "h", "l", "s", "fate", "reason")
    for column in table.columns[4:]:
        column.justify = "left"
    for line in note["lines"]:
        numbers = [f"{line[name]:.3f}" for name in ("h", "l", "s")]
        table.row(line["box"], *numbers, line["fate"], line["reason"])
    head = Text(f"Choice {number} at {note['at']:.1f} s", style="bold")
    shown: list[RenderableType] = [head, *map(Text, lines), table]
    return Report({"choices": [_fields(number, note, told)]}, shown)


def _about(notes: list[Note], box: BoxId) -> Report:
    """A box, from when it was seen first until it was chosen for good."""
    shown: list[RenderableType] = []
    fields: list[Json] = []
    before: tuple[str, ...] = ()
    for number, note in enumerate(notes, start=1):
        if all(line["box"] != box for line in note["lines"]):
            continue
        told = explained(note, box)
        lines = _lines(note, box, told)
        if lines != before:
            shown.append(Text(f"Choice {number} at {note['at']:.1f} s", style="bold"))
            shown += map(Text, lines)
        before = lines
        fields.append(_fields(number, note, told))
    return Report({"box": box, "choices": fields}, shown)


def _lines(note: Note, box: BoxId, told: Explanation | None) -> tuple[str, ...]:
    if told is not None:
        return told.lines
    line = next(line for line in note["lines"] if line["box"] == box)
    return (f"{box}: {line['fate']} ({line['reason']})",)


def _fields(number: int, note: Note, told: Explanation | None) -> dict[str, Json]:
    explanation = None if told is None else json.loads(json.dumps(asdict(told), default=said))
    lines: list[Json] = [] if told is None else list(told.lines)
    return {
        "choice": number,
        "at": note["at"],
        "target": note["target"],
        "outcome": note["outcome"],
        "explanation": explanation,
        "lines": lines,
    }


def recorded(note: Note) -> Explanation | None:
    """The explanation of the chosen box, as it was recorded."""
    fields = note["explanation"]
    if fields is None:
        return None
    return Explanation(
        **{
            **fields,
            "fate": Fate(fields["fate"]),
            "parts": Parts(**fields["parts"]),
            "before": tuple(fields["before"]),
            "changes": tuple(_change(each) for each in fields["changes"]),
        }
    )


def _change(fields: dict[str, Any]) -> Change:
    side = None if fields["side"] is None else Side(fields["side"])
    return Change(**{**fields, "kind": Kind(fields["kind"]), "side": side})


def explained(note: Note, box: BoxId) -> Explanation | None:
    """Why a box was chosen or not; None where the choice is not one of G's."""
    if box == note["target"]:
        return recorded(note)
    decision = decided_again(note)
    return None if decision is None else explain(decision, box)


def decided_again(note: Note) -> Decision[LeafAlone] | None:
    """The decision made again by the paper's rule; None where that is another one."""
    refused = {
        line["box"]: line["reason"]
        for line in note["lines"]
        if line["fate"] == Fate.UNREACHABLE.value
    }

    def grasp_for(box: Perceived) -> LeafAlone | Refused:
        return Refused(refused[box.id]) if box.id in refused else LeafAlone()

    weights = PositionWeights(**note["weights"])
    rule = ScoreRule(note["w"], note["x_max"], weights)
    requests = [Request(**fields) for fields in note["requests"]]
    try:
        graph = BlockingGraph([_box(line) for line in note["lines"]])
    except InputError:
        return None
    decision = select(graph, requests, rule, grasp_for)
    told = [(v.box.id, v.fate.value, v.reason) for v in decision.verdicts]
    same = told == [(line["box"], line["fate"], line["reason"]) for line in note["lines"]]
    return decision if same and note["by_score"] else None


def _box(line: dict[str, Any]) -> Perceived:
    x, y, z = line["centre"]
    a, b, c = line["size"]
    shape = OrientedBox.upright((x, y, z), (a, b, c), line["yaw"])
    if line["gtin"] is None:
        return Detection(BoxId(line["box"]), shape)
    return Recognition(BoxId(line["box"]), shape, Gtin(line["gtin"]))
