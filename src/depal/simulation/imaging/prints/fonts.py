"""The typeface of everything that is written in pictures: DejaVu Sans, as matplotlib ships it."""

from pathlib import Path

import matplotlib as mpl
from PIL import ImageFont


def font(size: int, *, bold: bool = True) -> ImageFont.FreeTypeFont:
    """Letters of a size [pixel]."""
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(Path(mpl.get_data_path()) / "fonts" / "ttf" / name, size)
