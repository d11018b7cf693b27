"""Pictures as files."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from depal.app.pictures.painter import CellPainter
from depal.simulation.snapshot import Snapshot

Bytes = npt.NDArray[np.uint8]

COLOURS = 256
"""An animation has so many colours, the same in every picture."""


def save_picture(path: Path, picture: Bytes) -> None:
    """Writes a picture (h, w, 3) as PNG."""
    Image.fromarray(picture).save(path, format="PNG", optimize=True)


def save_animation(
    path: Path,
    painter: CellPainter,
    moments: Iterable[tuple[Snapshot, str]],
    fps: float = 10.0,
    size: tuple[int, int] = (640, 480),
) -> None:
    """Writes moments of a run as an animated GIF that begins again after its end.

    Args:
        path: where to.
        painter: of the cell.
        moments: snapshots with their captions, in order.
        fps: pictures per second.
        size: width and height [pixel].

    Raises:
        ValueError: there is no moment.
    """
    frames: list[Image.Image] = []
    palette: Image.Image | None = None
    for snapshot, caption in moments:
        image = Image.fromarray(painter.picture(snapshot, caption, size))
        if palette is None:
            palette = image.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, kmeans=2)
        frames.append(image.quantize(palette=palette, dither=Image.Dither.NONE))
    if not frames:
        raise ValueError("an animation needs at least one moment")
    frames[0].save(
        path,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=round(1000 / fps),
        loop=0,
        optimize=False,
    )
