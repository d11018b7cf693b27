"""The label on every upright side: a GS1-128 barcode with the 14 digits of the case's number.

GS1-128 (application identifier 01, code set C) has 134 modules and fits faces of 104 mm at half a
millimetre a module; an ITF-14 of the same number is about as wide but has a far weaker check.
The label sits in the middle of a side's width, its middle up to 30 mm below the side's middle:
so it stays in the reader's field when the middle of a side is shown to the reader.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import zxingcpp
from PIL import Image, ImageDraw

from depal.simulation.imaging.prints.fonts import font

Bytes = npt.NDArray[np.uint8]

BARS = 134
"""Modules of a GS1-128 of 14 digits, start, identifier, check and stop included."""

QUIET = 10
"""Modules of white on both sides (GS1 General Specifications, section 5.4.6)."""

MODULES = (0.60e-3, 0.50e-3, 0.45e-3, 0.40e-3)
"""Widths of a module that are printed [m]."""

FINE = 3
"""Texels per module."""

MARGIN = 0.006
"""A label keeps so far off the edges of its side [m]."""

TALLEST = 0.055
SHORTEST = 0.025
LOWER = 0.03
"""A label's middle lies so far below the middle of its side at the most [m]."""


@dataclass(frozen=True, slots=True)
class Label:
    """Where a label is on a side and how large.

    Attributes:
        size: width and height [m].
        below: its middle below the middle of the side [m].
        module: width of a module [m].
    """

    size: tuple[float, float]
    below: float
    module: float


def label_for(side: tuple[float, float]) -> Label | None:
    """The label for a side of this width and height [m]; None where none fits."""
    width, height = side
    tall = min(height - 2 * MARGIN, TALLEST)
    roomy = [m for m in MODULES if _wide(m) <= width - 2 * MARGIN]
    if not roomy or tall < SHORTEST:
        return None
    size = (_wide(roomy[0]), tall)
    return Label(size, min((height - tall) / 2 - MARGIN, LOWER), roomy[0])


def label_image(gtin: str, name: str, label: Label) -> Bytes:
    """What is printed on a label, FINE texels per module along and across."""
    scale = FINE / label.module
    width, height = round(label.size[0] * scale), round(label.size[1] * scale)
    image = Image.new("L", (width, height), 252)
    draw = ImageDraw.Draw(image)
    digits = gtin.zfill(14)
    line = height * 0.16
    words, small = font(int(line * 0.8)), font(int(line * 0.7), bold=False)
    edge = QUIET * FINE
    draw.text((edge, line * 0.75), name, fill=20, font=words, anchor="lm")
    draw.text((width / 2, height - line * 0.75), f"(01) {digits}", fill=20, font=small, anchor="mm")
    bars = np.repeat(bars_of(digits), FINE)
    pixels = np.array(image)
    left = (width - len(bars)) // 2
    pixels[int(line * 1.4) : int(height - line * 1.4), left : left + len(bars)] = bars
    pixels[[0, -1], :] = pixels[:, [0, -1]] = 150
    return np.repeat(pixels[..., None], 3, axis=2)


def bars_of(digits: str) -> Bytes:
    """The modules of the barcode of 14 digits, (BARS,): 12 where dark, 252 where light."""
    code = zxingcpp.create_barcode(f"(01){digits}", zxingcpp.BarcodeFormat.Code128, gs1=True)
    drawn = np.array(zxingcpp.write_barcode_to_image(code, add_quiet_zones=False))
    return np.where(drawn[0] > 0, 252, 12).astype(np.uint8)


def _wide(module: float) -> float:
    return (BARS + 2 * QUIET) * module
