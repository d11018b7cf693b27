"""What is written in pictures of a run."""

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from depal.simulation.imaging.prints.fonts import font

Bytes = npt.NDArray[np.uint8]

INK = (38, 44, 54)
SOFT = (96, 104, 116)
PAPER = (252, 252, 253)
RULE = (214, 218, 224)


def caption_height(size: tuple[int, int], caption: str) -> int:
    """How much of a picture of this width and height its caption takes [pixel]."""
    lines = len(caption.splitlines())
    letters = _letters(size)
    return lines * _step(letters) + letters if lines else 0


def captioned(picture: Bytes, caption: str, bar: int) -> Bytes:
    """The picture with a caption below it.

    Args:
        picture: (h, w, 3) RGB.
        caption: lines; the first is set in bold. What is too long for a line is cut.
        bar: height of the caption [pixel].

    Returns:
        (h + bar, w, 3) RGB.
    """
    if not bar:
        return picture
    height, width = picture.shape[:2]
    image = Image.new("RGB", (width, height + bar), PAPER)
    image.paste(Image.fromarray(picture))
    draw = ImageDraw.Draw(image)
    draw.line((0, height, width, height), fill=RULE)
    size = _letters((width, height + bar))
    for number, line in enumerate(caption.splitlines()):
        letters = font(size, bold=number == 0)
        middle = height + size // 2 + _step(size) * number + _step(size) // 2
        words = _cut(line, letters, width - 2 * size)
        draw.text((size, middle), words, fill=SOFT if number else INK, font=letters, anchor="lm")
    return np.asarray(image)


def _letters(size: tuple[int, int]) -> int:
    """Height of the letters in a picture of this width and height [pixel]."""
    return max(round(min(size[1] * 0.029, size[0] * 0.022)), 9)


def _step(letters: int) -> int:
    return round(letters * 1.45)


def _cut(line: str, letters: ImageFont.FreeTypeFont, room: int) -> str:
    """As much of a line as there is room for."""
    if letters.getlength(line) <= room:
        return line
    kept = line
    while kept and letters.getlength(kept + "...") > room:
        kept = kept[:-1]
    return kept.rstrip() + "..."
