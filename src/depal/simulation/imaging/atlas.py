"""Textures with their coarser levels, in one array."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Bytes = npt.NDArray[np.uint8]
Ints = npt.NDArray[np.int64]

LEVELS = 8
"""A texture has this many levels, each half as wide and high as the one before."""


@dataclass(frozen=True, slots=True, eq=False)
class Atlas:
    """Textures as the kernels take them.

    Attributes:
        texels: (m, 3) RGB of all textures, row by row.
        table: (textures, LEVELS, 3) first texel, width and height of each level.
    """

    texels: Bytes
    table: Ints


class AtlasBuilder:
    """Collects textures; each gets a number."""

    def __init__(self) -> None:
        """An empty collection."""
        self._images: list[Bytes] = []

    def add(self, image: Bytes) -> int:
        """Takes a picture (h, w, 3) and says which texture it is."""
        self._images.append(image)
        return len(self._images) - 1

    def plain(self, colour: tuple[int, int, int]) -> int:
        """Takes one colour and says which texture it is."""
        return self.add(np.array(colour, dtype=np.uint8).reshape(1, 1, 3))

    def build(self) -> Atlas:
        """All textures so far."""
        rows, blocks, start = [], [], 0
        for image in self._images:
            level = image
            sizes = []
            for _ in range(LEVELS):
                height, width = level.shape[:2]
                sizes.append((start, width, height))
                blocks.append(level.reshape(-1, 3))
                start += height * width
                level = _halved(level)
            rows.append(sizes)
        texels = np.concatenate(blocks) if blocks else np.zeros((0, 3), dtype=np.uint8)
        return Atlas(texels, np.array(rows, dtype=np.int64).reshape(-1, LEVELS, 3))


def _halved(image: Bytes) -> Bytes:
    """The mean of two by two texels; the last row or column stands alone where the count is odd."""
    height, width = image.shape[:2]
    if height == 1 and width == 1:
        return image
    even = np.pad(image, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge").astype(np.uint16)
    total = even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2]
    return ((total + 2) // 4).astype(np.uint8)
