"""One scene: what the cameras show of a pallet, and what is true."""

import math
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from depal.domain import CellLayout, Delivery, DeliveryLine, Gtin
from depal.motion.kinematics import Kinematics
from depal.ports import Frame
from depal.simulation.cases import Case, cases_of
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import CellScene
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.wear import WEAR, Wear
from depal.simulation.scenes.foreign import with_foreign
from depal.simulation.scenes.piles import Kind, loosened, unloaded
from depal.simulation.scenes.truth import TrueBox, Truth, relations_of, seen_faces
from depal.simulation.snapshot import Snapshot
from depal.simulation.stacking import stacked

TURNS = {Severity.EASY: 0.0, Severity.NORMAL: math.radians(0.7), Severity.HARD: math.radians(1.5)}
"""How far boxes of a stack are turned in their places, as a standard deviation [rad]."""

GAPS = {Severity.EASY: 0.0, Severity.NORMAL: 0.008, Severity.HARD: 0.02}
"""By how much stacks are spread out at the most."""

JUMBLED = (math.radians(3.0), 0.02, 0.05)
"""The same for jumbled piles: turn [rad], smallest and largest spread."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A pallet before the cameras.

    Attributes:
        layout: the cell.
        frames: one of each of its cameras.
        truth: what stands there.
        note: what the cell believes to stand there: foreign boxes are not on it.
        severity: how hard it is.
        kind: what has happened to the stack.
        seed: it is the same for the same seed.
    """

    layout: CellLayout
    frames: tuple[Frame, ...]
    truth: Truth
    note: Delivery
    severity: Severity
    kind: Kind
    seed: int


def scene(
    delivery: Delivery,
    layout: CellLayout,
    seed: int,
    severity: Severity = Severity.NORMAL,
    kind: Kind = Kind.FULL,
    foreign: float = 0.0,
    known: frozenset[Gtin] = frozenset(),
) -> Scene:
    """Makes a scene.

    Args:
        delivery: its stack is used; where it has none, the note is stacked.
        layout: the cell, with its cameras.
        seed: of everything random in it.
        severity: how hard pictures and boxes are.
        kind: what has happened to the stack.
        foreign: share of the boxes that are replaced by products that nobody knows.
        known: products that foreign boxes are none of, beside those on the note.

    Returns:
        Frames and truth; box i of the truth is the same in both.

    Raises:
        DeliveryError: a note whose cases do not fit on the pallet.
    """
    random = np.random.default_rng([seed, 12])
    stack = delivery.stack if delivery.stack is not None else stacked(delivery)
    cases = cases_of(delivery, stack, layout)
    if kind is Kind.UNLOADED:
        cases = unloaded(cases, random)
    turn, gap = TURNS[severity], GAPS[severity] * float(random.random())
    if kind is Kind.JUMBLED:
        turn, low, high = JUMBLED
        gap = float(random.uniform(low, high))
    if turn > 0.0:
        cases = loosened(cases, random, turn, gap)
    cases, strangers = with_foreign(cases, foreign, random, known.union(delivery.products))
    printed = tuple(replace(case, index=k) for k, case in enumerate(cases))
    frames, truth = _seen(layout, printed, strangers, seed, severity)
    return Scene(layout, frames, truth, _note(delivery, cases), severity, kind, seed)


def _seen(
    layout: CellLayout,
    cases: tuple[Case, ...],
    strangers: frozenset[int],
    seed: int,
    severity: Severity,
) -> tuple[tuple[Frame, ...], Truth]:
    """The frames of all cameras, and the truth."""
    drawn = CellScene(layout, cases)
    snapshot, shapes = parked(layout, cases), [case.shape for case in cases]
    wear = Wear(shapes, WEAR[severity], seed)
    frames, views = [], []
    for mount in layout.cameras:
        model = CameraModel(drawn, mount, seed, severity, wear)
        frame, parts = model.shot(snapshot, 0.0, 0)
        frames.append(frame)
        views.append((model.lens, parts))
    boxes = tuple(
        TrueBox(case.shape, case.gtin, case.index in strangers, front, top)
        for case, (front, top) in zip(cases, seen_faces(shapes, layout, views), strict=True)
    )
    return tuple(frames), Truth(boxes, *relations_of(shapes))


def parked(layout: CellLayout, cases: tuple[Case, ...]) -> Snapshot:
    """The cell with its arm parked and the boxes where the cases say."""
    links = Kinematics(layout.robot).frames(layout.robot.parked)
    turns = Rotation.from_matrix(links[:, :, :3]).as_quat(scalar_first=True)
    arm = np.zeros((len(links) + 1, 7))
    arm[0, 3] = 1.0
    arm[1:, :3], arm[1:, 3:] = links[:, :, 3], turns
    boxes = np.zeros((len(cases), 7))
    if cases:
        boxes[:, :3] = [case.shape.centre for case in cases]
        boxes[:, 3:] = Rotation.from_matrix(
            np.array([case.shape.pose.rotation for case in cases])
        ).as_quat(scalar_first=True)
    bays: dict[str, str | None] = {storage.id: storage.id for storage in layout.storages}
    return Snapshot(0.0, arm, boxes, folded=True, held=(), removed=(), bays=bays)


def _note(delivery: Delivery, cases: tuple[Case, ...]) -> Delivery:
    """What of the note is still there."""
    counts = Counter(case.gtin for case in cases)
    lines = tuple(
        DeliveryLine(line.product, counts[line.product.gtin])
        for line in delivery.lines
        if counts[line.product.gtin]
    )
    return Delivery(delivery.id, delivery.pallet_size, lines)
