"""The last camera picture with what is believed to stand in it, as JPEG for the screen."""

import io
from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from depal.app.pictures.fronts import Floats, front_of
from depal.app.serve.seeing import Seen
from depal.app.serve.session import Session
from depal.domain import Recognition
from depal.ports import Frame
from depal.simulation.imaging.prints.fonts import font

WIDTH = 720
"""Of the picture for the screen [pixel]."""

MARGIN = 0.12
"""Shown around the boxes, as a share of the extent of all of them."""

MOST_MAGNIFIED = 4.0
"""Pixels of the screen's for one of the camera's; where fewer boxes are left, all is shown."""

NAMED, SEEN, TARGET = (0, 114, 178), (120, 120, 120), (213, 94, 0)


class Picture:
    """Drawn when somebody asks for it, once for each look."""

    def __init__(self) -> None:
        """No look yet."""
        self._session: Session | None = None
        self._seen: Seen | None = None
        self._drawn: tuple[int, bytes] = (0, b"")

    def watch(self, session: Session, seen: Seen) -> None:
        """The pictures of this run from now on."""
        self._session, self._seen = session, seen

    @property
    def number(self) -> int:
        """Of the last look; 0 where there was none."""
        frames = self._seen.frames if self._seen is not None else ()
        return round(frames[0].taken * 1000) + 1 if frames else 0

    def jpeg(self) -> bytes:
        """The picture; empty where no camera has looked."""
        number, session, seen = self.number, self._session, self._seen
        if not number or session is None or seen is None:
            return b""
        if self._drawn[0] != number:
            self._drawn = (number, _drawn(seen.frames[0], session))
        return self._drawn[1]


def _drawn(frame: Frame, session: Session) -> bytes:
    boxes = session.wired.work.pile.boxes
    outlines = [(box, front_of(frame, box.shape)) for box in boxes]
    shown = [(box, outline) for box, outline in outlines if outline is not None]
    left, top, right, bottom = view = _view(frame, [outline for _, outline in shown])
    scale = WIDTH / (right - left)
    image = Image.fromarray(frame.colour).resize((WIDTH, round((bottom - top) * scale)), box=view)
    draw = ImageDraw.Draw(image)
    target = session.note.target if session.note is not None else None
    for box, outline in sorted(shown, key=lambda each: each[0].id == target):
        colour = NAMED if isinstance(box, Recognition) else SEEN
        colour = TARGET if box.id == target else colour
        corners = [((x - left) * scale, (y - top) * scale) for x, y in outline.tolist()]
        draw.polygon(corners, outline=colour, width=3)
        x, y = np.mean(corners, axis=0).tolist()
        draw.text(
            (x, y), box.id, fill=colour, font=font(20, bold=True), anchor="mm",
            stroke_width=3, stroke_fill=(252, 252, 253),
        )  # fmt: skip
    out = io.BytesIO()
    image.save(out, "JPEG", quality=80)
    return out.getvalue()


def _view(frame: Frame, outlines: Sequence[Floats]) -> tuple[float, float, float, float]:
    """Left, top, right and bottom [pixel] of what the boxes fill, and a margin around it."""
    height, width = frame.colour.shape[:2]
    if not outlines:
        return (0, 0, width, height)
    corners = np.concatenate(outlines)
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = MARGIN * float(max(high - low))
    left, top = np.maximum(low - margin, 0.0).tolist()
    right, bottom = np.minimum(high + margin, (width, height)).tolist()
    if right - left < WIDTH / MOST_MAGNIFIED or bottom <= top:
        return (0, 0, width, height)
    return (left, top, right, bottom)
