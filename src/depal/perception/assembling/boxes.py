"""Boxes put together from the faces that were found."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product
from depal.geometry import OrientedBox, Pose
from depal.perception.assembling.edges import Lying
from depal.perception.assembling.pairing import paired
from depal.perception.assembling.sizing import Seen, Sized, sized
from depal.perception.faces import Face, Facing, SeenBox
from depal.perception.rasters.region import Region
from depal.perception.recognition import believed
from depal.perception.settling import Draft, Place, settled

Floats = npt.NDArray[np.float64]

GUESSED = 0.04
"""Standard deviation of an edge that nobody has seen [m]."""

UPRIGHT = math.radians(0.2)
"""Boxes stand so upright, as a standard deviation [rad]."""

UNMODELLED = (0.0015, 0.0015, 0.0, math.radians(0.2))
"""Beside what measurements say, x, y, z [m], yaw [rad] are off by so much: wrong edges, bulges."""

FREE = [0, 1, 2, 5]
"""Of a pose's six numbers those that an upright box leaves open."""

CARRIES = 0.05
"""A box stands on something that it overlaps by at least so much along x and y [m]."""


@dataclass(frozen=True, slots=True)
class _Part:
    """A box with its faces, before it is settled."""

    front: Lying | None
    top: Lying | None
    size: Sized
    gtin: Gtin | None

    @property
    def lying(self) -> tuple[Lying, ...]:
        return tuple(each for each in (self.front, self.top) if each is not None)


def boxes_of(
    faces: Sequence[Face], region: Region, products: Sequence[Product]
) -> tuple[SeenBox, ...]:
    """One box for each front, each top, and each two that belong together.

    Args:
        faces: found in one look, none overlapping another of its kind.
        region: where they were looked for.
        products: what may be there, the likeliest first; none where nobody knows.

    Returns:
        Boxes that agree with each other; their faces lie where their boxes are.
    """
    region_from_cell = region.cell_from_region.inverse
    lying = [Lying.of(face, region_from_cell) for face in faces]
    fronts = [each for each in lying if each.face.facing is Facing.FRONT]
    tops = [each for each in lying if each.face.facing is Facing.TOP]
    pairs = paired(fronts, tops)
    rest = set(range(len(fronts))) - {front for front, _ in pairs}
    left = set(range(len(tops))) - {top for _, top in pairs}
    both: list[tuple[Lying | None, Lying | None]] = [(fronts[i], tops[j]) for i, j in pairs]
    both += [(fronts[i], None) for i in sorted(rest)]
    both += [(None, tops[j]) for j in sorted(left)]
    parts = [_part(front, top, region, products, lying) for front, top in both]
    drafts = [_draft(part, region_from_cell) for part in parts]
    places = settled(drafts, region.ground)
    return tuple(
        _box(part, draft, region, state, covariance)
        for part, draft, state, covariance in zip(
            parts, drafts, places.states, places.covariances, strict=True
        )
    )


def _part(
    front: Lying | None,
    top: Lying | None,
    region: Region,
    products: Sequence[Product],
    all_: Sequence[Lying],
) -> _Part:
    parts = [each for each in (front, top) if each is not None]
    gtin, name = _named(parts), _supposed(parts)
    width = float(np.mean([each.width for each in parts]))
    seen = Seen(top.other if top else None, width, front.other if front else None)
    standing = () if front else _standing(parts[0], all_, region.ground)
    return _Part(front, top, sized(seen, products, gtin, standing, name), gtin)


def _draft(part: _Part, region_from_cell: Pose) -> Draft:
    size = part.size
    places = tuple(
        Place(each.face, region_from_cell @ each.face.cell_from_face, each.yaw)
        for each in part.lying
    )
    return Draft(places, (size.depth, size.width, size.height), size.tall)


def _box(part: _Part, draft: Draft, region: Region, state: Floats, covariance: Floats) -> SeenBox:
    shape = draft.shape(state)
    cell_from_box = region.cell_from_region @ shape.pose
    score = 1.0 - float(np.prod([1.0 - each.face.score for each in part.lying]))
    return SeenBox(
        OrientedBox(cell_from_box, draft.size),
        score,
        _covariance(part, region.cell_from_region, covariance),
        tuple(_on(cell_from_box, draft.size, each.face) for each in part.lying),
        part.gtin,
        part.size.certain,
    )


def _on(cell_from_box: Pose, size: tuple[float, float, float], face: Face) -> Face:
    """A face where its box has it."""
    depth, width, height = size
    if face.facing is Facing.FRONT:
        way = Pose((-depth / 2, 0.0, 0.0), ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))
        return replace(face, cell_from_face=cell_from_box @ way, size=(width, height))
    way = Pose((0.0, 0.0, height / 2), ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0)))
    return replace(face, cell_from_face=cell_from_box @ way, size=(width, depth))


def _named(parts: Sequence[Lying]) -> Gtin | None:
    """The product that the prints say together."""
    return believed([each.face.name for each in parts if each.face.name is not None])


def _supposed(parts: Sequence[Lying]) -> Gtin | None:
    """The product that the best print says, certain or not."""
    names = [each.face.name for each in parts if each.face.name is not None]
    return max(names, key=lambda name: name.score).gtin if names else None


def _standing(top: Lying, others: Sequence[Lying], ground: float) -> tuple[float, ...]:
    """The heights that a box under this top may have."""
    heights = [top.z - ground]
    for other in others:
        if other.face.facing is Facing.TOP and other.z < top.z - CARRIES:
            heights.append(top.z - other.z)
        if other.face.facing is Facing.FRONT:
            heights.append(top.z - other.front_edge[2])
    return tuple(each for each in heights if each > CARRIES)


def _covariance(part: _Part, cell_from_region: Pose, block: Floats) -> Floats:
    """(6, 6) in the cell frame."""
    own = np.zeros((6, 6))
    own[np.ix_(FREE, FREE)] = block + np.diag(np.square(UNMODELLED))
    own[3, 3] = own[4, 4] = UPRIGHT**2
    if not part.size.certain:
        own[0, 0] += 0.0 if part.top else (GUESSED / 2) ** 2
        own[2, 2] += 0.0 if part.size.tall else (GUESSED / 2) ** 2
    turn = np.kron(np.eye(2), np.array(cell_from_region.rotation))
    return np.asarray(turn @ own @ turn.T)
