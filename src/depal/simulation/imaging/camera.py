"""The simulated RGB-D camera."""

import asyncio

import numpy as np

from depal.domain import CameraMount
from depal.executive.clock import Clock
from depal.ports import Frame
from depal.simulation.imaging.depth_noise import DepthNoise, measured
from depal.simulation.imaging.lens import Lens, Light
from depal.simulation.imaging.mesh import Mesh
from depal.simulation.imaging.raster import Picture, render
from depal.simulation.imaging.scene import CellScene, Stage
from depal.simulation.imaging.sensor import sensed
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.shadows import add_shadows

EXPOSURE = 0.5
"""One picture takes so long [s]."""

GRAIN = 2.0
"""Standard deviation of a pixel's colour values."""

HALL = Light(towards=(-0.35, 0.25, 0.9), direct=0.4, above=0.62, below=0.5)
"""Lamps under the ceiling, a little nearer to the robot than the pallet."""

AROUND = 3.0
"""Shadows are thrown by what is within so much of the cell's middle [m]."""


WALL = (176, 178, 181)
"""Behind everything, out of the depths' reach."""


class CameraModel:
    """What one camera makes of a scene in one run.

    Attributes:
        mount: where it stands.
        severity: how far it is from ideal.
    """

    def __init__(
        self,
        scene: CellScene,
        mount: CameraMount,
        seed: int,
        severity: Severity = Severity.NORMAL,
        noise: DepthNoise | None = None,
    ) -> None:
        """A camera before a scene.

        Args:
            scene: whose textures it sees.
            mount: where it stands.
            seed: of all that is random in this run.
            severity: how far it is from ideal.
            noise: how good its depths are.
        """
        self.mount, self.severity = mount, severity
        self._scene, self._seed = scene, seed
        self._noise = noise or DepthNoise()

    def frame(self, mesh: Mesh, taken: float, number: int) -> Frame:
        """A picture of a moment.

        Args:
            mesh: everything that is there, in the cell frame.
            taken: when [s].
            number: of this picture in the run.

        Returns:
            The picture; the same for the same seed, moment and number.
        """
        return self.shot(mesh, taken, number)[0]

    def shot(self, mesh: Mesh, taken: float, number: int) -> tuple[Frame, Picture]:
        """The same, and what the depth's lens truly sees."""
        mount, atlas = self.mount, self._scene.atlas
        random = np.random.default_rng([self._seed, 7, number])
        colour_lens, depth_lens = (
            Lens.looking(mount.cell_from_camera, size, mount.vertical_view)
            for size in (mount.colour_size, mount.depth_size)
        )
        seen = render(mesh, atlas, colour_lens, HALL, WALL)
        add_shadows(seen, colour_lens, HALL, (0.0, 0.0, 0.8), AROUND)
        deep = render(mesh, atlas, depth_lens)
        frame = Frame(
            taken,
            sensed(seen.colour, GRAIN, random),
            measured(deep, depth_lens, self._noise, random),
            colour_lens.k,
            depth_lens.k,
            mount.cell_from_camera,
        )
        return frame, deep


class SimulatedCamera:
    """A camera on its mast; colour and depth see through the same lens."""

    def __init__(
        self,
        stage: Stage,
        clock: Clock,
        mount: CameraMount | None = None,
        severity: Severity = Severity.NORMAL,
        noise: DepthNoise | None = None,
    ) -> None:
        """A camera of this stage's world; the cell's first one where none is named."""
        self._stage, self._clock = stage, clock
        self._mount = mount or stage.world.layout.cameras[0]
        self._severity, self._noise = severity, noise
        self._taken = 0

    async def take(self) -> Frame:
        """Takes one picture at the end of its exposure."""
        await asyncio.sleep(EXPOSURE)
        now = self._clock.now()
        self._stage.world.advance(now)
        return self.frame(now)

    def frame(self, taken: float) -> Frame:
        """A picture of the world as it stands, taken at this time [s]."""
        seed = self._stage.world.seed
        model = CameraModel(self._stage.scene, self._mount, seed, self._severity, self._noise)
        self._taken += 1
        return model.frame(self._stage.now(), taken, self._taken - 1)
