"""The simulated RGB-D cameras of a cell, released together."""

import asyncio
import math
from dataclasses import replace

from depal.domain import CameraMount
from depal.executive.clock import Clock
from depal.geometry import Pose
from depal.geometry.abreast import abreast
from depal.ports import Frame
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import CellScene, Stage
from depal.simulation.imaging.severity import Severity
from depal.simulation.snapshot import Snapshot

EXPOSURE = 0.5
"""One look's pictures take so long [s]."""


class Shutter:
    """Releases the cameras of a cell together; their pictures are drawn side by side."""

    def __init__(self, stage: Stage) -> None:
        """Of no camera yet."""
        self._stage = stage
        self._cameras: list[SimulatedCamera] = []
        self._at = math.nan
        self._ready: dict[SimulatedCamera, Frame] = {}

    def join(self, camera: "SimulatedCamera") -> None:
        """One more camera is released with the others."""
        self._cameras.append(camera)

    def frame(self, camera: "SimulatedCamera", taken: float) -> Frame:
        """A camera's picture of the world as it stands at this time [s]; each is given once."""
        if taken != self._at or camera not in self._ready:
            self._expose(taken)
        return self._ready.pop(camera)

    def _expose(self, taken: float) -> None:
        scene, snapshot = self._stage.scene, self._stage.snapshot()
        frames = abreast(lambda each: each.exposed(scene, snapshot, taken), self._cameras)
        self._at, self._ready = taken, dict(zip(self._cameras, frames, strict=True))


class SimulatedCamera:
    """A camera on its mast; colour and depth see through the same lens."""

    def __init__(
        self,
        stage: Stage,
        clock: Clock,
        mount: CameraMount | None = None,
        severity: Severity = Severity.NORMAL,
        shutter: Shutter | None = None,
    ) -> None:
        """A camera of this stage's world; the cell's first one where none is named.

        Args:
            stage: what it stands before.
            clock: of the cell.
            mount: where it stands.
            severity: how far it is from ideal.
            shutter: releases it; one of its own where none is given.
        """
        self._stage, self._clock = stage, clock
        self._mount = mount or stage.world.layout.cameras[0]
        self._severity = severity
        self._model: CameraModel | None = None
        self._taken = 0
        self._shift: Pose | None = None
        self._shutter = shutter or Shutter(stage)
        self._shutter.join(self)

    @property
    def model(self) -> CameraModel:
        """What it is; made when somebody first looks."""
        return self._model_of(self._stage.scene)

    def _model_of(self, scene: CellScene) -> CameraModel:
        if self._model is None:
            seed = self._stage.world.seed
            self._model = CameraModel(scene, self._mount, seed, self._severity)
        return self._model

    def bump(self, shift: Pose | None) -> None:
        """It sees everything shifted by this; by nothing where None, as it was hung."""
        if shift == self._shift:
            return
        self._shift = shift
        pose = self._mount.cell_from_camera
        moved = pose if shift is None else shift.inverse @ pose
        self._model = self.model.at(replace(self._mount, cell_from_camera=moved))

    async def take(self) -> Frame:
        """Takes one picture at the end of its exposure."""
        await asyncio.sleep(EXPOSURE)
        now = self._clock.now()
        self._stage.world.advance(now)
        return self.frame(now)

    def frame(self, taken: float) -> Frame:
        """A picture of the world as it stands, taken at this time [s]."""
        frame = self._shutter.frame(self, taken)
        self._taken += 1
        return frame

    def exposed(self, scene: CellScene, snapshot: Snapshot, taken: float) -> Frame:
        """Its next picture, of a moment [s]; the same as long as none has been given away."""
        return self._model_of(scene).frame(snapshot, taken, self._taken)
