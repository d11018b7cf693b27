"""Fig. 10 over the camera's picture: the scores of boxes before and after a request."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw

from depal.app.pictures.fronts import front_of
from depal.geometry import OrientedBox
from depal.ports import Frame
from depal.simulation.imaging.prints.fonts import font

Bytes = npt.NDArray[np.uint8]
Floats = npt.NDArray[np.float64]

PAPER, INK, BEFORE, ASKED, EDGE = (
    (252, 252, 253),
    (20, 24, 30),
    (110, 116, 126),
    (28, 150, 76),
    (240, 240, 242),
)

FRONT = 4
"""A face has so many corners."""

SOFT = 0.72
"""The picture below the words is so much brighter: this share of it is paper."""


@dataclass(frozen=True, slots=True)
class Scored:
    """A box in one selection.

    Attributes:
        name: of the box.
        shape: in the cell frame.
        before: its score without the requests, Eq. (3).
        after: with them.
        wanted: whether a request asks for it.
    """

    name: str
    shape: OrientedBox
    before: float
    after: float
    wanted: bool = False


def score_picture(frame: Frame, boxes: Sequence[Scored]) -> Bytes:
    """The picture of a look, on each box its score before (grey) and after (black) a request.

    Args:
        frame: of the look before the selection; its pose is the camera's.
        boxes: those that are drawn; what the camera does not see whole is left out.

    Returns:
        (h, w, 3) RGB, the part of the frame that shows the boxes.
    """
    outlines = {
        box.name: outline for box in boxes if (outline := front_of(frame, box.shape)) is not None
    }
    picture = (frame.colour * (1.0 - SOFT) + np.array(PAPER) * SOFT).astype(np.uint8)
    for box in boxes:
        if box.name in outlines:
            _show(picture, frame.colour, outlines[box.name])
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    for box in sorted(boxes, key=lambda each: each.wanted):
        if box.name in outlines:
            _write(draw, box, outlines[box.name])
    return _cut(np.asarray(image), list(outlines.values()))


def _show(picture: Bytes, colour: Bytes, outline: Floats) -> None:
    """Half of the box's own picture, so that it is told from its surroundings."""
    mask = np.zeros(picture.shape[:2], np.uint8)
    cv2.fillConvexPoly(mask, np.round(outline).astype(np.int32), 255)
    picture[mask > 0] = (colour[mask > 0] * 0.55 + np.array(PAPER) * 0.45).astype(np.uint8)


def _write(draw: ImageDraw.ImageDraw, box: Scored, outline: Floats) -> None:
    corners = [(float(x), float(y)) for x, y in outline]
    draw.polygon(corners, outline=ASKED if box.wanted else EDGE, width=5 if box.wanted else 2)
    x, y = outline.mean(axis=0).tolist()
    size = max(round(float(np.ptp(outline[:, 1])) * 0.16), 11)
    lines = (
        (box.name, INK, True),
        (f"{box.before:.3f}", BEFORE, False),
        (f"{box.after:.3f}", INK, box.after != box.before),
    )
    for row, (words, ink, bold) in enumerate(lines):
        at = (x, y + (row - 1) * size * 1.25)
        draw.text(
            at, words, fill=ink, font=font(size, bold=bold), anchor="mm",
            stroke_width=2, stroke_fill=PAPER,
        )  # fmt: skip


def _cut(picture: Bytes, outlines: Sequence[Floats]) -> Bytes:
    """The part with the boxes and some surroundings."""
    if not outlines:
        return picture
    corners = np.concatenate(outlines)
    room = 0.12 * float(np.ptp(corners, axis=0).max())
    height, width = picture.shape[:2]
    left, top = np.maximum(corners.min(axis=0) - room, 0).astype(int)
    right, bottom = np.minimum(corners.max(axis=0) + room, (width, height)).astype(int)
    return picture[top:bottom, left:right]
