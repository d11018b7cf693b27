"""The patterns of fiducials: ArUco's dictionary of 50 with 4 x 4 bits."""

import cv2
import numpy as np
import numpy.typing as npt

MODULES = 6
"""Along an edge of the black square: four bits between a black rim."""

RIM = 1
"""White modules around the black square."""

PLATE = (MODULES + 2 * RIM) / MODULES
"""A plate's edge by its black square's."""

INK, PAPER = 26, 232
"""Grey values of what is printed black, and of the plate: nothing printed is 0 or 255."""


def dictionary() -> cv2.aruco.Dictionary:
    """The 50 patterns."""
    return cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)


def plate_picture(pattern: int, module: int = 20) -> npt.NDArray[np.uint8]:
    """A marker on its plate.

    Args:
        pattern: which of the 50.
        module: edge of a module [pixel].

    Returns:
        A square grey picture, 8 modules wide.
    """
    black = cv2.aruco.generateImageMarker(dictionary(), pattern, MODULES * module, borderBits=1)
    printed = np.where(black > 0, PAPER, INK).astype(np.uint8)
    return np.pad(printed, RIM * module, constant_values=PAPER)
