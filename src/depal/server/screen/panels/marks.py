"""How boxes, tasks and modes are told apart: a shape and a word, and a muted tint."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType
from typing import Final

from depal.executive.drawing.palette import PALETTE, Tint
from depal.executive.tree import NodeState
from depal.server.cellstate import CellState, Mode, QueueLine


class Mark(Enum):
    """What stands out among the boxes on the pallet."""

    ASKED = "asked"
    TARGET = "target"
    REQUESTED = "requested"
    BLOCKER = "blocker"
    PLAIN = "plain"


SHAPES: Final[Mapping[Mark, str]] = MappingProxyType(
    {
        Mark.ASKED: "?",
        Mark.TARGET: "▼",
        Mark.REQUESTED: "★",
        Mark.BLOCKER: "◆",
        Mark.PLAIN: "",
    }
)

TINTS: Final[Mapping[Mark, Tint]] = MappingProxyType(
    {
        Mark.ASKED: Tint("#ffc933", "#7a5a00", "#2a2000"),
        Mark.TARGET: Tint("#cfdff2", "#1d4473", "#1d4473"),
        Mark.REQUESTED: Tint("#e6dcef", "#5b3a7a", "#4a2d66"),
        Mark.BLOCKER: Tint("#e9e2d3", "#6d5a2c", "#55451f"),
        Mark.PLAIN: Tint("#dedad2", "#8a857b", "#4d4a44"),
    }
)

ICONS: Final[Mapping[Mode, str]] = MappingProxyType(
    {
        Mode.IDLE: "radio_button_unchecked",
        Mode.EXECUTE: "play_arrow",
        Mode.HELD: "pause",
        Mode.SUSPENDED: "hourglass_top",
        Mode.STOPPED: "stop",
        Mode.ABORTED: "dangerous",
        Mode.COMPLETE: "check",
    }
)


@dataclass(frozen=True, slots=True)
class NodeLook:
    """How a task is drawn: as in the paper's figures, muted.

    Attributes:
        tint: the paper's colour.
        shape: for those who do not see it.
    """

    tint: Tint
    shape: str


NODES: Final[Mapping[str, NodeLook]] = MappingProxyType(
    {
        "accomplished": NodeLook(PALETTE[NodeState.ACCOMPLISHED], "✓"),
        "running": NodeLook(PALETTE[NodeState.ENABLED], "▶"),
        "enabled": NodeLook(PALETTE[NodeState.ENABLED], "○"),
        "disabled": NodeLook(PALETTE[NodeState.DISABLED], "·"),
    }
)


def blockers_of(state: CellState) -> frozenset[str]:
    """The boxes that must go before a requested one, directly or not."""
    lines = {line.box: line for line in state.queue}
    found: set[str] = set()
    ahead = [name for line in state.queue if line.requested for name in line.blockers]
    while ahead:
        name = ahead.pop()
        if name in found:
            continue
        found.add(name)
        ahead.extend(lines[name].blockers if name in lines else ())
    return frozenset(found)


def marks_of(state: CellState) -> dict[str, Mark]:
    """What each box on the pallet is, the most important first."""
    blockers = blockers_of(state)
    asked = {question.about for question in state.questions}
    return {line.box: _mark(line, state.target, asked, blockers) for line in state.queue}


def _mark(
    line: QueueLine, target: str | None, asked: Collection[str], blockers: Collection[str]
) -> Mark:
    if line.box in asked:
        return Mark.ASKED
    if line.box == target:
        return Mark.TARGET
    if line.requested:
        return Mark.REQUESTED
    return Mark.BLOCKER if line.box in blockers else Mark.PLAIN
