"""What really stands before the cameras, as the referee of perception asks about it."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.faces import Facing
from depal.simulation.imaging.prints.design import Stock, design_of, family_of
from depal.simulation.scenes import Scene

Floats = npt.NDArray[np.float64]

COUNTS = 0.7
"""A face of which less is seen need not be found."""

STOCKS = {Stock.GRAPHIC: "printed", Stock.KRAFT: "kraft", Stock.PLAIN: "plain"}
"""How they are called."""

_SQUARE = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


@dataclass(frozen=True, slots=True)
class TrueFace:
    """A front or a top of a box that stands there.

    Attributes:
        facing: which way it looks.
        box: whose it is: an index.
        cell_from_face: its middle; x along its width, y down (or to the viewer), z into the box.
        size: width and height [m].
        visible: share of it that any camera sees within 70 degrees of its normal.
    """

    facing: Facing
    box: int
    cell_from_face: Pose
    size: tuple[float, float]
    visible: float = 1.0

    @property
    def counts(self) -> bool:
        """Whether it must be found."""
        return self.visible >= COUNTS

    @property
    def corners(self) -> Floats:
        """(4, 3) in the cell [m], around the face."""
        return corners_of(self.cell_from_face, self.size)


@dataclass(frozen=True, slots=True)
class TrueBox:
    """A box that stands there.

    Attributes:
        shape: in the cell frame.
        gtin: its product.
        stock: what it is made of and how much is printed on it, one of `STOCKS`' words.
        known: whether the store has pictures of the product.
        sibling: whether a product that the store has pictures of differs from it in text or
            colour alone.
    """

    shape: OrientedBox
    gtin: Gtin
    stock: str = "printed"
    known: bool = True
    sibling: bool = False


@dataclass(frozen=True, slots=True)
class Truth:
    """A scene as it is.

    Attributes:
        boxes: all that stand there.
        faces: the front and the top of every box.
    """

    boxes: tuple[TrueBox, ...]
    faces: tuple[TrueFace, ...]


def truth_of(scene: Scene, known: Sequence[Product]) -> Truth:
    """The truth of a simulated scene.

    Args:
        scene: the scene.
        known: the products that the store has pictures of.
    """
    numbers = {product.gtin for product in known}
    kin = [(product.gtin, family_of(product.gtin), _edges(product.size)) for product in known]
    boxes = tuple(
        TrueBox(
            box.shape,
            box.gtin,
            STOCKS[design_of(box.gtin).stock],
            box.gtin in numbers,
            _has_sibling(box.gtin, box.shape.size, kin),
        )
        for box in scene.truth.boxes
    )
    faces = tuple(
        TrueFace(facing, index, face.cell_from_face, face.size, face.visible)
        for index, box in enumerate(scene.truth.boxes)
        for facing, face in ((Facing.FRONT, box.front), (Facing.TOP, box.top))
    )
    return Truth(boxes, faces)


def corners_of(cell_from_face: Pose, size: tuple[float, float]) -> Floats:
    """Upper left, upper right, lower right, lower left of a face: (4, 3) in the cell [m]."""
    flat = np.column_stack((_SQUARE * size, np.zeros(4)))
    turn = np.array(cell_from_face.rotation)
    return np.asarray(flat @ turn.T + np.array(cell_from_face.translation))


def _has_sibling(
    gtin: Gtin, size: Vector3, known: Collection[tuple[Gtin, str, tuple[int, ...]]]
) -> bool:
    """Whether a known product of the same range is as large."""
    family, edges = family_of(gtin), _edges(size)
    return any(other != gtin and its == family and theirs == edges for other, its, theirs in known)


def _edges(size: Vector3) -> tuple[int, ...]:
    """The edges of a box in whole millimetres, whichever way it stands."""
    return tuple(sorted(round(1000 * edge) for edge in size))
