"""The simulated RGB-D camera."""

import asyncio

import numpy as np

from depal.domain import CameraMount
from depal.executive.clock import Clock
from depal.ports import Frame
from depal.simulation.imaging.depth_noise import DepthNoise, measured
from depal.simulation.imaging.lens import Lens, Light
from depal.simulation.imaging.raster import render
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.sensor import sensed
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


class SimulatedCamera:
    """A camera on its mast; colour and depth see through the same lens."""

    def __init__(
        self,
        stage: Stage,
        clock: Clock,
        mount: CameraMount | None = None,
        noise: DepthNoise | None = None,
    ) -> None:
        """A camera of this stage's world; the cell's first one where none is named."""
        self._stage, self._clock = stage, clock
        self._mount = mount or stage.world.layout.cameras[0]
        self._noise = noise or DepthNoise()
        self._taken = 0

    async def take(self) -> Frame:
        """Takes one picture at the end of its exposure."""
        await asyncio.sleep(EXPOSURE)
        now = self._clock.now()
        self._stage.world.advance(now)
        return self.frame(now)

    def frame(self, taken: float) -> Frame:
        """A picture of the world as it stands, taken at this time [s]."""
        mount, world = self._mount, self._stage.world
        atlas, mesh = self._stage.scene.atlas, self._stage.now()
        random = np.random.default_rng([world.seed, 7, self._taken])
        self._taken += 1
        colour_lens, depth_lens = (
            Lens.looking(mount.cell_from_camera, size, mount.vertical_view)
            for size in (mount.colour_size, mount.depth_size)
        )
        seen = render(mesh, atlas, colour_lens, HALL, WALL)
        add_shadows(seen, colour_lens, HALL, (0.0, 0.0, 0.8), AROUND)
        deep = render(mesh, atlas, depth_lens)
        return Frame(
            taken,
            sensed(seen.colour, GRAIN, random),
            measured(deep, depth_lens, self._noise, random),
            colour_lens.k,
            depth_lens.k,
            mount.cell_from_camera,
        )
