"""What an active stereo camera makes of true depths.

Depth comes from a disparity d = f b / z between two lenses, b apart: its error grows with z^2 and
it comes in steps. A disparity is found for a window of pixels, so neighbours err alike, depth steps
become slopes, and the nearer surface grows over its edge. What only one lens sees is a hole, and so
are ragged bits of edges, film that shines, and faces seen flatly. The projector's pattern does not
change from exposure to exposure, so most of the error stays however many are taken; a frame stands
for the median of about ten.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from statistics import NormalDist
from types import MappingProxyType
from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.smooth_noise import smooth_noise

Floats = npt.NDArray[np.float32]
Flags = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class DepthErrors:
    """How good the depths are. Lengths in the picture are in units of the focal length.

    Attributes:
        baseline: between the two lenses [m].
        static: standard deviation of a disparity's error that stays [focal length].
        temporal: of the error that is left of many exposures [focal length].
        alike: pixels within this of each other err alike, as a Gauss curve's width.
        window: width of the window in which a disparity is found.
        fatten: how far the nearer surface grows over its edge, at least and at most.
        ragged: share of the larger depth steps where nothing is measured.
        steps: a disparity comes in steps of 1 / steps [pixel].
        flattest: cosine of the angle between sight and normal below which nothing is measured.
        glare: film that shines more than this is not measured.
        reach: nearest and farthest depth that is measured [m].
        bias: every depth is wrong by a share drawn up to this.
    """

    baseline: float = 0.05
    static: float = 1.2e-4
    temporal: float = 1.5e-5
    alike: float = 0.008
    window: float = 0.0165
    fatten: tuple[float, float] = (0.001, 0.004)
    ragged: float = 0.2
    steps: int = 32
    flattest: float = 0.15
    glare: float = 0.5
    reach: tuple[float, float] = (0.4, 6.0)
    bias: float = 0.007


DEPTH: Mapping[Severity, DepthErrors] = MappingProxyType(
    {
        Severity.EASY: DepthErrors(
            0.095, 0.0, 6.4e-5, 0.0, 0.003, (0.0, 0.0), 0.1, glare=2.0, bias=0.0
        ),
        Severity.NORMAL: DepthErrors(),
        Severity.HARD: DepthErrors(
            static=1.7e-4, temporal=3e-5, window=0.02, fatten=(0.002, 0.007), ragged=0.4, bias=0.01
        ),
    }
)

LARGE = 0.02
"""A step of the inverse depth above this is an edge [1/m]: 60 mm at 1.75 m."""

TILE = 512
"""Noise that changes repeats after so many pixels, from another place in each picture."""


class DepthSensor:
    """The errors of one camera's depths in one run."""

    def __init__(self, lens: Lens, errors: DepthErrors, seed: tuple[int, ...]) -> None:
        """Draws what stays during the run.

        Args:
            lens: of the depth picture.
            errors: how good it is.
            seed: of the run and the camera.
        """
        random = np.random.default_rng([*seed, 17])
        self._errors, self._focal = errors, lens.focal[0]
        width, height = lens.size
        self.bias = float(random.uniform(-errors.bias, errors.bias))
        self.scale = self._focal * errors.baseline
        alike = max(errors.alike * self._focal, 0.5)
        coarse = _field((height, width), alike, random)
        fine = _field((height, width), alike / 2.5, random)
        self._static = (0.87 * coarse + 0.49 * fine) * np.float32(errors.static * self._focal)
        self._torn = coarse > NormalDist().inv_cdf(1.0 - errors.ragged)
        self._wander = _field((height, width), 1.6 * alike, random) > 0.0
        blur = max(alike / 4, 0.5)
        self._changing = smooth_noise((TILE, TILE), (blur, blur), random)
        self._changing *= np.float32(errors.temporal * self._focal)

    def measured(
        self, disparity: Floats, holes: Flags, random: np.random.Generator
    ) -> npt.NDArray[np.float32]:
        """The depths that the camera tells.

        Args:
            disparity: (h, w) true ones [pixel]; 0 where nothing stands.
            holes: (h, w) what cannot be measured.
            random: draws what changes from picture to picture.

        Returns:
            (h, w) along the optical axis [m]; 0 where nothing was measured.
        """
        errors, focal = self._errors, self._focal
        least, most = (_dilated(disparity, round(width * focal)) for width in errors.fatten)
        grown = np.empty_like(disparity)
        grow(disparity, least, most, self._wander, LARGE / 2 * self.scale, grown)
        size = max(round(errors.window * focal), 1)
        square = np.ones((size, size), dtype=np.uint8)
        wide = cv2.morphologyEx(holes.view(np.uint8), cv2.MORPH_OPEN, square)
        seen = np.asarray(cv2.blur(grown, (size, size)), dtype=np.float32)
        near, far = errors.reach
        limits = np.array(
            [
                *(errors.steps, self.scale / far, self.scale / near),
                *(LARGE * self.scale, self.scale * (1.0 + self.bias)),
            ]
        )
        noise = Noise(self._static, self._changing, random.integers(0, TILE, 2), self._torn)
        depth = np.empty_like(disparity)
        tell(seen, grown, noise, np.asarray(wide), limits, depth)
        return depth


class Noise(NamedTuple):
    """Errors of one picture.

    Attributes:
        static: (h, w) of disparities, the same in all pictures [pixel].
        changing: (TILE, TILE) the rest of them; it repeats.
        shift: (2,) where that begins.
        torn: (h, w) where an edge is not measured.
    """

    static: Floats
    changing: Floats
    shift: npt.NDArray[np.int64]
    torn: Flags


@loop_kernel
def tell(
    seen: Floats,
    grown: Floats,
    noise: Noise,
    wide: npt.NDArray[np.uint8],
    limits: npt.NDArray[np.float64],
    depth: Floats,
) -> None:
    """Depths from disparities in steps.

    Args:
        seen: (h, w) disparities as windows see them [pixel].
        grown: (h, w) the same before, with sharp edges.
        noise: what is added, and where edges are torn.
        wide: (h, w) not 0 where nothing is measured.
        limits: (5,) steps per pixel; least and greatest disparity; the least step of an edge;
            disparity times the depth that is told.
        depth: (h, w) [m]; filled, 0 where nothing is measured.
    """
    height, width = seen.shape
    for y in range(height):
        for x in range(width):
            value = seen[y, x] + noise.static[y, x]
            value += noise.changing[(y + noise.shift[0]) % TILE, (x + noise.shift[1]) % TILE]
            value = np.floor(value * limits[0] + 0.5) / limits[0]
            hole = wide[y, x] != 0 or value < limits[1] or value > limits[2]
            if not hole and noise.torn[y, x] and 0 < x < width - 1 and 0 < y < height - 1:
                across = abs(grown[y, x + 1] - grown[y, x - 1])
                down = abs(grown[y + 1, x] - grown[y - 1, x])
                hole = max(across, down) > limits[3]
            depth[y, x] = 0.0 if hole else limits[4] / value


@loop_kernel
def grow(
    disparity: Floats, least: Floats, most: Floats, wander: Flags, step: float, grown: Floats
) -> None:
    """Lets nearer surfaces grow over their edges; slanted ones stay what they are.

    Args:
        disparity: (h, w) true [pixel].
        least: (h, w) the greatest of the neighbours nearby.
        most: (h, w) the same of a wider neighbourhood.
        wander: (h, w) where the wider one is taken.
        step: what differs by less is one surface [pixel].
        grown: (h, w) filled.
    """
    height, width = disparity.shape
    for y in range(height):
        for x in range(width):
            near = most[y, x] if wander[y, x] else least[y, x]
            grown[y, x] = near if near - disparity[y, x] > step else disparity[y, x]


def _dilated(disparity: Floats, width: int) -> Floats:
    """The greatest disparity within so many pixels."""
    if width == 0:
        return disparity
    square = np.ones((2 * width + 1, 2 * width + 1), dtype=np.uint8)
    return np.asarray(cv2.dilate(disparity, square), dtype=np.float32)


def _field(shape: tuple[int, int], width: float, random: np.random.Generator) -> Floats:
    """Smooth noise, drawn coarsely where it is smooth enough."""
    coarser = max(int(width / 1.5), 1)
    small = (-(-shape[0] // coarser), -(-shape[1] // coarser))
    field = smooth_noise(small, (width / coarser, width / coarser), random)
    if coarser == 1:
        return field
    large = cv2.resize(field, shape[::-1], interpolation=cv2.INTER_LINEAR)
    return np.asarray(large / max(float(large.std()), 1e-9), dtype=np.float32)
