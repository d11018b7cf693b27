"""Perception: what it finds, names and relates on scenes that it was never tuned on, and how fast.

A detection of a face that is there but less than 70 % visible is neither right nor wrong; see
`depal.studies.perception` for the rest of the rules.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from depal.domain import Delivery
from depal.errors import FrameError, Problem, SettingError, did_you_mean
from depal.logistics import shipped_deliveries
from depal.perception.frames import RecordedFrame, frame_folders, read_frame_folder
from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.perception_result import Result
from depal.studies.perception.real import score_frame, variants
from depal.studies.perception.scenes import (
    FIRST_SEED,
    Perception,
    Piece,
    measure,
    measure_times,
    pieces,
)
from depal.studies.sweep import Progress, no_progress, sweep

ALL = "all"
"""The word for every severity."""

BUSY = ("dev-056", "dev-041", "dev-024")
"""The deliveries that ship which show the most faces: 31 to 38 that count."""

TIMED = 12
"""So many looks are timed, one after another in one process."""

TIMED_SEED = FIRST_SEED - 1_000
"""Of the scenes that are timed."""


@dataclass(frozen=True, slots=True)
class Extent:
    """How much is measured.

    Attributes:
        severities: of the simulated scenes.
        scenes: so many of each severity, every kind in its turn; 0 measures real frames alone.
        seed: another one gives other scenes.
        noted: whether perception is told the note.
        timed: so many scenes are looked at for the time that it takes.
    """

    severities: tuple[Severity, ...] = tuple(Severity)
    scenes: int = 201
    seed: int = 0
    noted: bool = True
    timed: int = TIMED


def bench_perception(
    extent: Extent,
    perception: Perception,
    frames: Sequence[Path] = (),
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Measures every figure.

    Args:
        extent: how much.
        perception: what is measured.
        frames: folders of real frames with masks, or of such folders.
        executor: works on scenes; None does in this process.
        progress: told how far it is.

    Raises:
        FrameError: a folder that holds no frame that can be used.
    """
    folders = [folder for path in frames for folder in frame_folders(path)]
    real = {_name(folder, folders): _marked(folder) for folder in folders}
    asked = [
        piece
        for severity in extent.severities
        for piece in pieces(severity, extent.scenes, extent.seed, noted=extent.noted)
    ]
    busy = busy_pieces(extent.timed if extent.scenes else 0)
    total = len(asked) + len(busy) + len(real)
    scenes = sweep(
        partial(measure, perception=perception), asked, executor, lambda n, _: progress(n, total)
    )
    timed = []
    for number, (piece, delivery) in enumerate(busy, start=len(asked)):
        progress(number, total)
        timed.append(measure_times(piece, perception, delivery))
    frame_scores = {}
    for number, (name, frame) in enumerate(real.items(), start=len(asked) + len(busy)):
        progress(number, total)
        frame_scores[name] = [score_frame(frame, variant, perception) for variant in variants()]
    progress(total, total)
    by_severity = {
        severity: [one for one in scenes if one.piece.severity is severity]
        for severity in extent.severities
        if extent.scenes
    }
    return Result(by_severity, timed[bool(timed) :], frame_scores)


def severities_of(word: str) -> tuple[Severity, ...]:
    """The severities that a word means: one by its name, or `ALL`.

    Raises:
        SettingError: there is none of that name.
    """
    if word == ALL:
        return tuple(Severity)
    if word not in tuple(Severity):
        exists = did_you_mean(word, [*Severity, ALL])
        raise SettingError("--severity", f"unknown severity {word!r}", exists=exists)
    return (Severity(word),)


def busy_pieces(count: int) -> list[tuple[Piece, Delivery]]:
    """Scenes with many faces to be timed, and one before them that only warms up."""
    if not count:
        return []
    kinds = (Kind.FULL, Kind.JUMBLED)
    shipped = {delivery.id: delivery for delivery in shipped_deliveries()}
    return [
        (
            Piece(Severity.NORMAL, kinds[k // len(BUSY) % 2], TIMED_SEED + k),
            shipped[BUSY[k % len(BUSY)]],
        )
        for k in range(count + 1)
    ]


def _marked(folder: Path) -> RecordedFrame:
    """A frame with masks."""
    frame = read_frame_folder(folder)
    if not frame.masks:
        what = "there are no masks to compare with"
        raise FrameError(str(folder), [Problem("masks", what, "a PNG for each face, masks/*.png")])
    return frame


def _name(folder: Path, folders: Sequence[Path]) -> str:
    """What a frame's folder is called; with its parent where another one is called the same."""
    alone = [other.name for other in folders].count(folder.name) == 1
    return folder.name if alone else f"{folder.parent.name}/{folder.name}"
