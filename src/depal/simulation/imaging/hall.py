"""The light of one run: lamps, beams before them, and what the sensor makes of their colour."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Pose
from depal.simulation.imaging.lens import Lens, Light
from depal.simulation.imaging.mesh import Mesh, cuboid
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.shadows import AWAY

Floats = npt.NDArray[np.float64]

HALL = Light(towards=(-0.35, 0.25, 0.9), direct=0.4, above=0.62, below=0.5)
"""Lamps under the ceiling, a little nearer to the robot than the pallet."""

BEHIND = 0.02
"""What lies less than this behind the first surface is lit, where light falls straight [m]."""

CEILING = 4.2
"""Beams hang so high; no camera sees them, but their shadows [m]."""

MIDDLE = np.array((1.8, 0.0, 0.8))
"""Where the light's changes over the cell are counted from [m]."""


@dataclass(frozen=True, slots=True)
class LightSettings:
    """How much the light differs from run to run.

    Attributes:
        turn: of the light's direction, standard deviation along x and y.
        gain: smallest and largest brightness.
        balance: of each colour's gain, standard deviation.
        gradient: how much brighter it becomes over a metre, at the most.
        beams: how probable shadows of beams are.
        grain: standard deviation of a pixel's colour values.
        blur: the lens spreads a point over so many pixels, as a Gauss curve's width.
    """

    turn: float
    gain: tuple[float, float]
    balance: float
    gradient: float
    beams: float
    grain: float
    blur: float


LIGHT: Mapping[Severity, LightSettings] = MappingProxyType(
    {
        Severity.EASY: LightSettings(0.0, (1.0, 1.0), 0.0, 0.0, 0.0, 2.0, 0.6),
        Severity.NORMAL: LightSettings(0.25, (0.75, 1.1), 0.025, 0.15, 0.5, 2.5, 0.7),
        Severity.HARD: LightSettings(0.45, (0.55, 1.25), 0.05, 0.3, 0.8, 4.0, 1.0),
    }
)


@dataclass(frozen=True, slots=True, eq=False)
class RunLight:
    """The light of one run as one camera sees it.

    Attributes:
        light: what shines.
        gains: (3,) of red, green, blue.
        gradient: (3,) how much brighter it becomes along the cell's axes [1/m].
        beams: shapes that stand before the lamps.
        settings: what it was drawn from.
    """

    light: Light
    gains: Floats
    gradient: Floats
    beams: tuple[OrientedBox, ...]
    settings: LightSettings

    @classmethod
    def drawn(cls, severity: Severity, seed: int, camera: int) -> "RunLight":
        """The light of a run; lamps and beams are the same for all its cameras."""
        settings = LIGHT[severity]
        random = np.random.default_rng([seed, 14])
        x, y = (np.array(HALL.towards[:2]) + random.normal(0.0, settings.turn, 2)).tolist()
        share = float(random.uniform(-1.0, 1.0)) * settings.turn
        light = Light((x, y, HALL.towards[2]), 0.4 + 0.3 * share, 0.62 - 0.3 * share, 0.5)
        gradient = random.uniform(-1.0, 1.0, 3) * settings.gradient
        beams = _beams(random) if random.random() < settings.beams else ()
        own = np.random.default_rng([seed, 14, camera])
        gains = float(own.uniform(*settings.gain)) * np.clip(
            own.normal(1.0, settings.balance, 3), 0.8, 1.2
        )
        return cls(light, gains, gradient, beams, settings)

    def on(self, mesh: Mesh) -> Floats:
        """Brightness at the corners of triangles in the cell, (n, 3)."""
        slope = 1.0 + (mesh.corners - MIDDLE) @ self.gradient
        return np.asarray(self.light.on(mesh.normals) * np.clip(slope, 0.4, 1.6))

    def in_shadow(self, mesh: Mesh, sun: Lens) -> Floats:
        """What shadows do to triangles, (n, 2).

        Args:
            mesh: in the cell.
            sun: the light's lens.

        Returns:
            The share of its brightness that each keeps in the shadow; and how far behind the
            light's first surface it is lit [m]: a face that the light meets flatly reaches far over
            one of the light's pixels.
        """
        lit = self.light.on(mesh.normals).mean(axis=1)
        around = Light(self.light.towards, 0.0, self.light.above, self.light.below)
        kept = around.on(mesh.normals).mean(axis=1) / np.maximum(lit, 1e-9)
        towards = np.array(self.light.towards) / np.linalg.norm(self.light.towards)
        facing = np.clip(np.abs(mesh.normals.mean(axis=1) @ towards), 0.05, 1.0)
        pixel = AWAY / sun.focal[0]
        return np.column_stack((kept, BEHIND + 2 * pixel * np.sqrt(1.0 - facing**2) / facing))

    def casters(self) -> list[Mesh]:
        """What throws shadows and is in no picture."""
        return [cuboid(beam.size, (0,)).moved(beam.pose) for beam in self.beams]


def _beams(random: np.random.Generator) -> tuple[OrientedBox, ...]:
    """One to three beams between the lamps and the pallet."""
    shapes = []
    for _ in range(int(random.integers(1, 4))):
        x, y = random.uniform(-0.6, 1.2), random.uniform(-0.2, 2.0)
        width, turn = random.uniform(0.05, 0.25), random.uniform(0.0, np.pi)
        pose = Pose.from_yaw((float(x), float(y), CEILING), float(turn))
        shapes.append(OrientedBox(pose, (6.0, float(width), 0.1)))
    return tuple(shapes)
