"""Faces of boxes as the camera sees them, and what is known of a whole box."""

from dataclasses import dataclass, field
from enum import Enum

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose


class Facing(Enum):
    """Which way a face looks."""

    FRONT = "front"
    TOP = "top"


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle in the plane of a raster.

    Attributes:
        u: of its middle, to the right [m].
        v: of its middle, downward [m].
        width: along its own first axis [m].
        height: along its own second axis [m].
        turn: of its first axis against the raster's rows, clockwise as seen [rad].
        depth: of its middle behind the raster's plane [m].
    """

    u: float
    v: float
    width: float
    height: float
    turn: float = 0.0
    depth: float = 0.0

    @property
    def corners(self) -> npt.NDArray[np.float64]:
        """Upper left, upper right, lower right, lower left: (4, 2) u, v [m]."""
        c, s = np.cos(self.turn), np.sin(self.turn)
        half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (self.width / 2, self.height / 2)
        return np.asarray(half @ np.array([[c, s], [-s, c]]) + (self.u, self.v))


@dataclass(frozen=True, slots=True, eq=False)
class Raster:
    """Surfaces that face one way, seen orthographically: the nearest at every place.

    The raster's frame: x to the right along the rows, y down along the columns, z away from the
    viewer; its origin is the middle of the pixel (0, 0), at depth 0.

    Attributes:
        facing: which faces it shows.
        cell_from_raster: its frame.
        step: edge of a pixel [m].
        colour: (h, w, 3) uint8, RGB; a little beyond the edges of what is known too, where depths
            are often missing; black beyond that.
        depth: (h, w) float32 along z, smoothed [m]; nan where nothing is known.
        known: (h, w) bool: depth and colour were seen by a camera.
    """

    facing: Facing
    cell_from_raster: Pose
    step: float
    colour: npt.NDArray[np.uint8]
    depth: npt.NDArray[np.float32]
    known: npt.NDArray[np.bool_]

    def pose_of(self, rectangle: Rectangle) -> Pose:
        """`cell_from_face`: x along the rectangle's width, y down, z into the box."""
        c, s = float(np.cos(rectangle.turn)), float(np.sin(rectangle.turn))
        turned = ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))
        return self.cell_from_raster @ Pose((rectangle.u, rectangle.v, rectangle.depth), turned)


@dataclass(frozen=True, slots=True)
class Name:
    """What the print on a face says.

    Attributes:
        gtin: the product.
        side: of the product: "end", "side" or "top".
        score: how well picture and print agree, in [0, 1].
        certain: whether it may be believed: every rival is excluded, siblings too.
        quarter: turns by 90 degrees clockwise of the print as seen; tops alone have other than 0.
        odds: that it is no other product's, unknown siblings included [logarithm].
        rivals: products that the face does not exclude.
    """

    gtin: Gtin
    side: str
    score: float
    certain: bool
    quarter: int = 0
    odds: float = 0.0
    rivals: tuple[Gtin, ...] = ()


@dataclass(frozen=True, slots=True)
class Errors:
    """How exactly a face's place is known: u, v along its own axes, its depth, its yaw.

    The yaw is that of the box, clockwise as seen from above.

    Attributes:
        covariance: (4, 4) of the four [m, rad], but for what the camera does wrong everywhere.
        camera: that has seen it, by its place among the frames.
        sway: by how much the four change for each share by which the camera's depths are too long.
    """

    covariance: tuple[tuple[float, ...], ...]
    camera: int
    sway: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Face:
    """A detected face.

    Attributes:
        facing: which way it looks.
        cell_from_face: its middle; x along its width, y down (or to the viewer), z into the box.
        size: width and height [m].
        score: the probability that it is a face of one box.
        visible: share of it that a camera saw.
        name: what its print says, where anything matches.
        errors: of its pose; None where nobody has measured it closely.
    """

    facing: Facing
    cell_from_face: Pose
    size: tuple[float, float]
    score: float
    visible: float = 1.0
    name: Name | None = None
    errors: Errors | None = None


@dataclass(frozen=True, slots=True, eq=False)
class SeenBox:
    """A box, put together from its faces.

    Attributes:
        shape: in the cell frame; its own z is up.
        score: the probability that it is one box.
        covariance: (6, 6) of x, y, z [m] and turns about x, y, z [rad], in the cell frame.
        faces: what was seen of it.
        gtin: the product, where the print could be believed.
        sized: whether all three edges are known, from faces or from the product.
    """

    shape: OrientedBox
    score: float
    covariance: npt.NDArray[np.float64]
    faces: tuple[Face, ...] = ()
    gtin: Gtin | None = None
    sized: bool = True


@dataclass(frozen=True, slots=True)
class Relation:
    """Something between two boxes, by their indices.

    Attributes:
        upper: the one that stands on the other, or that hides it.
        lower: the other.
        probability: that it is so.
    """

    upper: int
    lower: int
    probability: float


@dataclass(frozen=True, slots=True)
class Look:
    """What one look at the pallet found.

    Attributes:
        boxes: in no particular order.
        on_top: which stands on which (section II-C).
        occludes: which hides which from the camera (section II-C).
        faces: all that were detected, those of the boxes included.
    """

    boxes: tuple[SeenBox, ...]
    on_top: tuple[Relation, ...] = ()
    occludes: tuple[Relation, ...] = ()
    faces: tuple[Face, ...] = field(default=())
