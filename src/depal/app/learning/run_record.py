"""The choices of a recorded run, from the folder that `depal run --record` writes."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from depal.errors import OrderError, Problem
from depal.selection import Fate
from depal.selection.learning import Choice, features_of

CHOICES = "choices.jsonl"
"""The file of a record that is read."""

COULD_BE_TAKEN = (Fate.CHOSEN.value, Fate.NOT_TRIED.value)
"""The boxes that nothing blocked and whose grasp was not refused."""


@dataclass(frozen=True, slots=True)
class RunChoices:
    """What one run chose between.

    Attributes:
        choices: those between two boxes or more.
        forced: how often there was one box only.
    """

    choices: tuple[Choice, ...]
    forced: int


def read_run(folder: Path) -> RunChoices:
    """The choices of a record.

    Raises:
        OrderError: the record has none, or was written by a version that kept no poses.
    """
    path = folder / CHOICES
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise OrderError(str(path), [Problem("", f"cannot be read: {error}")]) from None
    choices: list[Choice] = []
    forced = 0
    for number, line in enumerate(lines, start=1):
        try:
            choice = _choice_of(json.loads(line))
        except (ValueError, KeyError, TypeError, AttributeError):
            what = "has no choice with the boxes' places"
            expected = "a record of this version; run it again with --record"
            raise OrderError(str(path), [Problem(f"line {number}", what, expected)]) from None
        if choice is None:
            forced += 1
        else:
            choices.append(choice)
    return RunChoices(tuple(choices), forced)


def _choice_of(note: dict[str, Any]) -> Choice | None:
    lines = [line for line in note["lines"] if line["fate"] in COULD_BE_TAKEN]
    if note["target"] is None or len(lines) == 1:
        return None
    centres = np.array([line["centre"] for line in lines], float)
    inherited = np.array([line["l"] for line in lines], float)
    features = features_of(centres, inherited, float(note["x_max"]))
    chosen = [line["box"] for line in lines].index(note["target"])
    return Choice(features, chosen)
