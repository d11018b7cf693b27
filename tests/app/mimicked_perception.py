"""Perception that is not there: the simulator's truth with every failure that perception has.

It stands where `perceive` stands: frames are not looked at. Boxes are missed, taken for another
size, cut in two, run together, left unnamed, or named wrongly; what is wrong with a box stays so
for some looks, as it does with a real detector, which is wrong for a reason.
"""

import asyncio
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from depal.app.run.values import Job
from depal.cell.sight import CameraSight, Eyes
from depal.domain import DeliveryLine, Gtin
from depal.executive.clock import Clock
from depal.geometry import OrientedBox, Pose
from depal.perception.detecting import Refuted
from depal.perception.faces import Look, SeenBox
from depal.perception.memory import Memory
from depal.perception.pictures import PictureBook
from depal.ports import Frame
from depal.simulation.cell import SimulatedCell
from depal.simulation.truth_sight import SightSettings, TruthSight

SIGMA = (0.004, 0.003, 0.003, 0.002, 0.002, 0.005)
"""Of position [m] and turns [rad]."""

LASTS = 4
"""What goes wrong with a box goes wrong for so many looks."""


@dataclass(frozen=True, slots=True)
class Failures:
    """How often what goes wrong, by box; `missed` .. `merged` by box and period."""

    missed: float = 0.03
    missized: float = 0.04
    split: float = 0.01
    merged: float = 0.02
    unnamed: float = 0.15
    misnamed: float = 0.0
    share: float = 0.4
    phantoms: float = 0.01


@dataclass(slots=True)
class Mimic:
    """`perceive` of a world."""

    cell: SimulatedCell
    failures: Failures = field(default_factory=Failures)
    seed: int = 0
    looks: int = 0

    def __call__(
        self,
        frames: Sequence[Frame],
        expected: tuple[DeliveryLine, ...] | None,
        book: PictureBook,
        before: Look | None,
        refuted: Refuted,
    ) -> Look:
        """What a look finds."""
        del frames, expected, book, before, refuted
        number, self.looks = self.looks, self.looks + 1
        sight = TruthSight(self.cell.world, _Still(), SightSettings(share=self.failures.share))
        visible = sorted(sight.visible_boxes())
        random = np.random.default_rng([self.seed, 9, number])
        found: list[SeenBox] = []
        joined: set[int] = set()
        for index in visible:
            if index in joined or self._happens(index, number, 1, self.failures.missed):
                continue
            if self._happens(index, number, 2, self.failures.merged):
                other = self._beside(index, visible)
                if other is not None:
                    joined.add(other)
                    found.append(self._merged(index, other))
                    continue
            if self._happens(index, number, 3, self.failures.split):
                found += self._split(index)
                continue
            found.append(self._one(index, number, random))
        if random.random() < self.failures.phantoms and found:
            x, y, z = found[0].shape.centre
            found.append(_seen(OrientedBox.upright((x, y, z + 0.4), (0.2, 0.2, 0.15)), 0.55))
        return Look(tuple(found))

    def rest(
        self, frames: Sequence[Frame], boxes: Sequence[OrientedBox]
    ) -> tuple[OrientedBox, ...]:
        """Visible boxes that no believed box explains, as depths would show them."""
        del frames
        sight = TruthSight(self.cell.world, _Still(), SightSettings(share=0.02))
        steps = (np.arange(8) + 0.5) / 8 - 0.5
        grid = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3)
        out = []
        for index in sorted(sight.visible_boxes()):
            pose, size = self._truth(index)
            points = (grid * np.array(size)) @ np.array(pose.rotation).T
            points += np.array(pose.translation)
            free = np.ones(len(points), dtype=bool)
            for box in boxes:
                inverse = box.pose.inverse
                local = points @ np.array(inverse.rotation).T + np.array(inverse.translation)
                free &= ~(np.abs(local) < np.array(box.size) / 2 + 0.03).all(axis=1)
            if free.sum() > 4:
                low, high = points[free].min(axis=0), points[free].max(axis=0)
                middle = tuple(((low + high) / 2).tolist())
                out.append(OrientedBox.upright(middle, tuple((high - low + 0.02).tolist())))
        return tuple(out)

    def _happens(self, index: int, number: int, kind: int, share: float) -> bool:
        period = 0 if kind > 4 else number // LASTS
        random = np.random.default_rng([self.seed, kind, index, period])
        return bool(random.random() < share)

    def _truth(self, index: int) -> tuple[Pose, tuple[float, float, float]]:
        return self.cell.world.box(index), self.cell.world.cases[index].shape.size

    def _one(self, index: int, number: int, random: np.random.Generator) -> SeenBox:
        case = self.cell.world.cases[index]
        pose, size = self._truth(index)
        errors = random.normal(0.0, 1.0, 6) * np.array(SIGMA)
        centre = np.array(pose.translation) + errors[:3]
        yaw = math.atan2(pose.rotation[1][0], pose.rotation[0][0]) + float(errors[5])
        gtin: Gtin | None = case.gtin
        if self._happens(index, number, 5, self.failures.unnamed):
            gtin = None
        elif self._happens(index, number, 6, self.failures.misnamed):
            others = sorted({c.gtin for c in self.cell.world.cases} - {case.gtin})
            gtin = others[index % len(others)] if others else None
        if gtin is None and self._happens(index, number, 4, self.failures.missized):
            wrong = np.random.default_rng([self.seed, 8, index]).uniform(-0.02, 0.02, 3)
            size = tuple((np.array(size) + wrong).tolist())
        shape = OrientedBox(Pose.from_yaw(tuple(centre.tolist()), yaw), size)
        return _seen(shape, 0.9, gtin)

    def _split(self, index: int) -> list[SeenBox]:
        """Two halves beside each other."""
        pose, (a, b, c) = self._truth(index)
        out = []
        for side in (-0.25, 0.25):
            centre = pose.apply((0.0, side * b, 0.0))
            out.append(_seen(OrientedBox(Pose(centre, pose.rotation), (a, b / 2, c)), 0.6))
        return out

    def _beside(self, index: int, visible: Sequence[int]) -> int | None:
        """A box of the same height and depth, flush to the side."""
        x, y, z = self.cell.world.box(index).translation
        for other in visible:
            u, v, w = self.cell.world.box(other).translation
            if other != index and abs(x - u) < 0.03 and abs(z - w) < 0.02 and 0 < v - y < 0.5:
                return other
        return None

    def _merged(self, one: int, two: int) -> SeenBox:
        """One box that covers both."""
        corners = np.concatenate([OrientedBox(*self._truth(index)).corners for index in (one, two)])
        low, high = corners.min(axis=0), corners.max(axis=0)
        return _seen(
            OrientedBox(Pose(tuple(((low + high) / 2).tolist())), tuple((high - low).tolist())), 0.6
        )


def _seen(shape: OrientedBox, score: float, gtin: Gtin | None = None) -> SeenBox:
    return SeenBox(shape, score, np.diag(np.square(SIGMA)), (), gtin)


class _Still:
    """A clock that nobody reads."""

    def now(self) -> float:
        """Never."""
        return 0.0


@dataclass(slots=True)
class QuickCamera:
    """Takes no picture, and the time for it."""

    clock: Clock
    cell: SimulatedCell

    async def take(self) -> Frame:
        """Nothing."""
        await asyncio.sleep(0.5)
        self.cell.world.advance(self.clock.now())
        k = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        empty = np.zeros((2, 2), dtype=np.float32)
        return Frame(self.clock.now(), np.zeros((2, 2, 3), dtype=np.uint8), empty, k, k, Pose())


def mimicking(failures: Failures | None = None):  # noqa: ANN201 - a callable of `run_job`
    """What a run sees with."""

    def seeing(job: Job, cell: SimulatedCell, clock: Clock) -> CameraSight:
        mimic = Mimic(cell, failures or Failures(), job.seed)
        eyes = Eyes(mimic, mimic.rest)
        cameras = [QuickCamera(clock, cell)]
        memory = Memory(places=job.named)
        return CameraSight(cameras, eyes, PictureBook(), job.delivery.lines, clock, memory)

    return seeing
