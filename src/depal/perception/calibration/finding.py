"""Markers in a picture: all of them anywhere, or each where it is expected."""

from collections.abc import Iterable, Mapping

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import Fiducial
from depal.geometry import Matrix3, Pose
from depal.perception.calibration.markers import MODULES, PLATE, dictionary

Floats = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]
Found = Mapping[int, Floats]
"""By pattern the corners of the black square, clockwise from its upper left: (4, 2) [pixel]."""

SMALLEST = 24.0
"""A marker whose shorter diagonal is shorter cannot be read [pixel]."""

STEEPEST = 0.25
"""A marker is looked at when the cosine between its normal and the sight is greater."""

AHEAD = 0.1
"""What is nearer to the lens is not looked for [m]."""


def corners_of(fiducial: Fiducial, edge: float = 1.0) -> Floats:
    """Corners of a marker in the cell, clockwise from its upper left: (4, 3) [m].

    Args:
        fiducial: the marker.
        edge: of the square by its black square's; `PLATE` is its plate.
    """
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * fiducial.size * edge / 2
    turn = np.array(fiducial.cell_from_marker.rotation)
    return np.asarray(square @ turn.T + np.array(fiducial.cell_from_marker.translation))


def projected(points: Floats, k: Matrix3, cell_from_camera: Pose) -> Floats:
    """Points in the cell, (n, 3) [m], in a picture: (n, 3) x, y [pixel] and depth [m]."""
    turn, shift = np.array(cell_from_camera.rotation), np.array(cell_from_camera.translation)
    x, y, z = ((points - shift) @ turn).T
    far = np.maximum(z, AHEAD)
    (fx, _, cx), (_, fy, cy), _ = k
    return np.column_stack((fx * x / far + cx, fy * y / far + cy, z))


def grey_of(colour: Bytes) -> Bytes:
    """The brightness of a picture (h, w, 3)."""
    return np.asarray(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), dtype=np.uint8)


def found_anywhere(colour: Bytes, patterns: Iterable[int]) -> dict[int, Floats]:
    """All markers of these patterns in a picture; one that shows twice does not count."""
    return _read(grey_of(colour), frozenset(patterns))


def expected(
    fiducials: Iterable[Fiducial], k: Matrix3, size: tuple[int, int], cell_from_camera: Pose
) -> dict[int, Floats]:
    """Which markers a camera sees whole and well where nothing hides them, and where.

    Args:
        fiducials: all of the cell.
        k: intrinsics of its picture.
        size: width and height of its picture [pixel].
        cell_from_camera: its pose.

    Returns:
        By pattern the corners of the black square: (4, 2) [pixel].
    """
    there = dict[int, Floats]()
    lens = np.array(cell_from_camera.translation)
    for fiducial in fiducials:
        turn = np.array(fiducial.cell_from_marker.rotation)
        way = np.array(fiducial.cell_from_marker.translation) - lens
        plate = projected(corners_of(fiducial, PLATE), k, cell_from_camera)
        x, y, z = plate.T
        inside = x.min() >= 0 and y.min() >= 0 and x.max() < size[0] and y.max() < size[1]
        steep = way @ turn[:, 2] <= STEEPEST * np.linalg.norm(way)
        if steep or z.min() < AHEAD or not inside:
            continue
        corners = projected(corners_of(fiducial), k, cell_from_camera)[:, :2]
        diagonals = np.linalg.norm(corners[:2] - corners[2:], axis=1)
        if diagonals.min() >= SMALLEST:
            there[fiducial.id] = corners
    return there


def found_near(grey: Bytes, where: Found, reach: float) -> dict[int, Floats]:
    """Markers near the places where they are expected.

    Args:
        grey: the picture's brightness.
        where: the corners that are expected.
        reach: how far from there a marker is still found [pixel].

    Returns:
        Those that were found.
    """
    height, width = grey.shape
    seen = dict[int, Floats]()
    for pattern, corners in where.items():
        rim = reach + 0.25 * float(np.ptp(corners, axis=0).max())
        left, top = np.maximum(np.floor(corners.min(axis=0) - rim), 0).astype(int)
        right, bottom = np.ceil(corners.max(axis=0) + rim).astype(int)
        window = grey[top : min(bottom, height), left : min(right, width)]
        here = _read(np.ascontiguousarray(window), frozenset((pattern,)))
        if pattern in here:
            seen[pattern] = here[pattern] + (left, top)
    return seen


def _read(grey: Bytes, patterns: frozenset[int]) -> dict[int, Floats]:
    settings = cv2.aruco.DetectorParameters()
    settings.minMarkerPerimeterRate = min(4 * SMALLEST / 2 / max(grey.shape), 1.0)
    settings.adaptiveThreshWinSizeMin = 13
    settings.adaptiveThreshWinSizeMax = 33
    settings.adaptiveThreshWinSizeStep = 20
    detector = cv2.aruco.ArucoDetector(dictionary(), settings)
    squares, ids, _ = detector.detectMarkers(grey)
    names = list[int]() if ids is None else [int(i) for i in np.asarray(ids).ravel()]
    return {
        name: _refined(grey, np.asarray(square, dtype=np.float32).reshape(4, 1, 2))
        for name, square in zip(names, squares, strict=True)
        if name in patterns and names.count(name) == 1
    }


def _refined(grey: Bytes, corners: npt.NDArray[np.float32]) -> Floats:
    """Corners to a fraction of a pixel; the window holds no corner of the pattern inside."""
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=(1, 2))
    half = int(np.clip(edges.min() / MODULES * 0.45, 2, 8))
    until = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 40, 0.005)
    better = cv2.cornerSubPix(grey, corners.copy(), (half, half), (-1, -1), until)
    return np.asarray(better, dtype=np.float64).reshape(4, 2)
