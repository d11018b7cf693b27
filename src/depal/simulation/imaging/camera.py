"""The simulated RGB-D camera."""

import asyncio
from dataclasses import replace

from depal.domain import CameraMount
from depal.executive.clock import Clock
from depal.geometry import Pose
from depal.ports import Frame
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.severity import Severity

EXPOSURE = 0.5
"""One look's pictures take so long [s]."""


class SimulatedCamera:
    """A camera on its mast; colour and depth see through the same lens."""

    def __init__(
        self,
        stage: Stage,
        clock: Clock,
        mount: CameraMount | None = None,
        severity: Severity = Severity.NORMAL,
    ) -> None:
        """A camera of this stage's world; the cell's first one where none is named."""
        self._stage, self._clock = stage, clock
        self._mount = mount or stage.world.layout.cameras[0]
        self._severity = severity
        self._model: CameraModel | None = None
        self._taken = 0
        self._shift: Pose | None = None

    @property
    def model(self) -> CameraModel:
        """What it is; made when somebody first looks."""
        if self._model is None:
            scene, seed = self._stage.scene, self._stage.world.seed
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
        self._taken += 1
        return self.model.frame(self._stage.snapshot(), taken, self._taken - 1)
