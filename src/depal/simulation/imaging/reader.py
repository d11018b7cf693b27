"""The simulated barcode reader: it decodes a picture of what its lens sees."""

import asyncio
import re

import cv2
import numpy as np
import numpy.typing as npt
import zxingcpp

from depal.domain import ReaderMount
from depal.executive.clock import Clock
from depal.simulation.imaging.lens import Lens, Light
from depal.simulation.imaging.raster import render
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.sensor import sensed

Bytes = npt.NDArray[np.uint8]

READING = 0.3
"""One reading takes so long [s]."""

NOISE = 3.0
"""Standard deviation of a pixel's grey value."""

TILTS = (0.0, 22.5, -22.5, 45.0)
"""The picture is searched for bars along its rows and columns, turned by these angles [degree]."""

GS1_CASE = re.compile(rb"01([0-9]{14})")
"""What a label says: the identifier of a trade item's number, then the number."""


class SimulatedReader:
    """A reader on its post, its own light beside the lens."""

    def __init__(self, stage: Stage, clock: Clock) -> None:
        """The reader of this stage's world."""
        self._stage, self._clock = stage, clock
        self._readings = 0

    async def read(self) -> tuple[str, ...]:
        """What it decodes now, 14 digits each; empty where it sees no code."""
        self._stage.world.advance(self._clock.now())
        codes = codes_in(self.picture())
        await asyncio.sleep(READING)
        return codes

    def picture(self) -> Bytes:
        """What the lens sees of the world as it stands, (h, w) grey."""
        world, scene = self._stage.world, self._stage.scene
        lens = lens_of(world.layout.reader)
        mesh = scene.mobile(self._stage.now())
        seen = render(mesh, scene.atlas, lens, _beside(lens), sky=(30, 30, 30))
        random = np.random.default_rng([world.seed, 6, self._readings])
        self._readings += 1
        return sensed(np.asarray(cv2.cvtColor(seen.colour, cv2.COLOR_RGB2GRAY)), NOISE, random)


def lens_of(mount: ReaderMount) -> Lens:
    """The lens whose picture is as wide and high as the field at the mount's distance."""
    (wide, high), (width, height) = mount.field, mount.pixels
    focal = (width / wide * mount.distance, height / high * mount.distance)
    return Lens(mount.cell_from_reader, mount.pixels, focal, ((width - 1) / 2, (height - 1) / 2))


def codes_in(picture: Bytes) -> tuple[str, ...]:
    """The numbers on the labels in a picture (h, w), 14 digits each, in order."""
    formats = zxingcpp.barcode_formats_from_str("Code128")
    for tilt in TILTS:
        found = zxingcpp.read_barcodes(_turned(picture, tilt), formats=formats, try_invert=False)
        cases = [GS1_CASE.fullmatch(code.bytes) for code in found]
        numbers = {case[1].decode() for case in cases if case is not None}
        if numbers:
            return tuple(sorted(numbers))
    return ()


def _turned(picture: Bytes, tilt: float) -> Bytes:
    """The picture turned about its middle [degree]; what leaves the frame is lost."""
    if tilt == 0.0:
        return picture
    height, width = picture.shape
    turn = cv2.getRotationMatrix2D((width / 2, height / 2), tilt, 1.0)
    return np.asarray(cv2.warpAffine(picture, turn, (width, height)), dtype=np.uint8)


def _beside(lens: Lens) -> Light:
    """A light beside the lens."""
    x, y, z = (-row[2] for row in lens.cell_from_camera.rotation)
    return Light((x, y, z), direct=0.7, above=0.3, below=0.3)
