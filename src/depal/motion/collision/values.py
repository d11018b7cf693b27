"""What can collide, as arrays: the scene around the arm, and the arm with what it holds."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, Grasp, Robot, Tool, Zone
from depal.geometry import OrientedBox, Vector3

Array = npt.NDArray[np.float64]

ZONE = "zone "
"""Zones are called so in a scene, and then by their names."""

SPACING = 0.6
"""Spheres along a capsule stand at most this many radii apart."""

APART = 3
"""Links nearer in the chain overlap by construction; the forearm may still meet the column."""


class Solids(NamedTuple):
    """Boxes in one frame.

    Attributes:
        centre: (n, 3) [m].
        rotation: (n, 3, 3) columns are the boxes' axes.
        half: (n, 3) half edges [m].
        low: (n, 3) smallest coordinates of each [m].
        high: (n, 3) greatest ones [m].
    """

    centre: Array
    rotation: Array
    half: Array
    low: Array
    high: Array


def solids_of(boxes: Iterable[OrientedBox]) -> Solids:
    """Boxes as arrays."""
    listed = list(boxes)
    n = len(listed)
    centre = np.array([box.centre for box in listed], float).reshape(n, 3)
    rotation = np.array([box.pose.rotation for box in listed], float).reshape(n, 3, 3)
    half = np.array([box.size for box in listed], float).reshape(n, 3) / 2
    reach = np.einsum("nij,nj->ni", np.abs(rotation), half)
    return Solids(centre, rotation, half, centre - reach, centre + reach)


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """What stands around the arm.

    Attributes:
        names: of the solids, for explanations.
        solids: where they are, in the cell frame.
        pile: (n,) whether a held box may rub along it in straight moves: cases, not the cell.
    """

    names: tuple[str, ...]
    solids: Solids
    pile: npt.NDArray[np.bool_]

    @classmethod
    def of(
        cls, fixed: Sequence[tuple[str, OrientedBox]], cases: Sequence[tuple[str, OrientedBox]]
    ) -> "Scene":
        """From the cell's own solids and the cases in it, each with its name."""
        both = [*fixed, *cases]
        pile = np.zeros(len(both), np.bool_)
        pile[len(fixed) :] = True
        return cls(tuple(name for name, _ in both), solids_of(box for _, box in both), pile)

    def without(self, *names: str) -> "Scene":
        """The scene when these are not there."""
        gone = set(names)
        keep = np.array([name not in gone for name in self.names], np.bool_)
        kept = tuple(name for name in self.names if name not in gone)
        return Scene(kept, Solids(*(part[keep] for part in self.solids)), self.pile[keep])

    def with_case(self, name: str, box: OrientedBox) -> "Scene":
        """The scene with one more case."""
        return self._with([(name, box)], pile=True)

    def with_zones(self, zones: Sequence[Zone]) -> "Scene":
        """The scene with volumes that nothing may enter, as if they were solid."""
        named = [(f"{ZONE}{zone.name}", zone.solid) for zone in zones]
        return self._with(named, pile=False) if named else self

    @property
    def zones(self) -> "Scene":
        """The scene's zones alone."""
        return self.without(*(name for name in self.names if not name.startswith(ZONE)))

    def _with(self, named: Sequence[tuple[str, OrientedBox]], *, pile: bool) -> "Scene":
        more = solids_of(box for _, box in named)
        joined = Solids(*(np.concatenate(pair) for pair in zip(self.solids, more, strict=True)))
        names = (*self.names, *(name for name, _ in named))
        return Scene(names, joined, np.append(self.pile, [pile] * len(named)))


def fixed_solids(layout: CellLayout) -> list[tuple[str, OrientedBox]]:
    """The cell's own solids: pallet, storages, fixtures; with names, in the cell frame."""
    length, width, deck = layout.pallet.size
    pallet = OrientedBox.from_corner((0.0, 0.0, -deck), (length, width, deck))
    solids = [("the pallet", pallet.seen_from(layout.pallet.cell_from_pallet))]
    for storage in layout.storages:
        solids += [
            (storage.id, panel.seen_from(storage.cell_from_storage)) for panel in storage.panels
        ]
    solids += [(f"fixture {number}", box) for number, box in enumerate(layout.fixtures, start=1)]
    return solids


class Arm(NamedTuple):
    """The arm's capsules.

    Attributes:
        link: (m,) which link each belongs to; 0 is the base.
        start: (m, 3) in the link's frame [m].
        end: (m, 3) [m].
        radius: (m,) [m].
        spheres: (m,) how many spheres cover each for the test against boxes.
        cover: (m,) their radius [m]: so that they contain the capsule.
        pairs: (p, 2) capsules of links that could meet: the upper one, the lower one.
    """

    link: npt.NDArray[np.int64]
    start: Array
    end: Array
    radius: Array
    spheres: npt.NDArray[np.int64]
    cover: Array
    pairs: npt.NDArray[np.int64]


def arm_of(robot: Robot) -> Arm:
    """The capsules of an arm as arrays."""
    shapes = robot.shapes
    start = np.array([shape.start for shape in shapes], float).reshape(-1, 3)
    end = np.array([shape.end for shape in shapes], float).reshape(-1, 3)
    radius = np.array([shape.radius for shape in shapes], float)
    length = np.linalg.norm(end - start, axis=1)
    count = np.ceil(length / (SPACING * radius)).astype(np.int64) + 1
    step = length / np.maximum(count - 1, 1)
    cover = np.sqrt(radius**2 + (step / 2) ** 2)
    link = np.array([shape.link for shape in shapes], np.int64)
    pairs = [
        (upper, lower)
        for lower in range(len(link))
        for upper in range(len(link))
        if link[upper] - link[lower] >= APART or (link[lower], link[upper]) == (1, 3)
    ]
    together = np.array(pairs, np.int64).reshape(-1, 2)
    return Arm(link, start, end, radius, count, cover, together)


@dataclass(frozen=True, slots=True, eq=False)
class Hand:
    """The tool and what it holds, in the flange's frame.

    Attributes:
        solids: the tool's parts, then the held box where there is one.
        holding: whether the last solid is a held box.
    """

    solids: Solids
    holding: bool

    @classmethod
    def of(cls, tool: Tool, *, folded: bool = False, held: OrientedBox | None = None) -> "Hand":
        """The tool with the lower module up or down, and a held box in the flange's frame."""
        parts = list(tool.folded_shapes if folded else tool.shapes)
        return cls(solids_of([*parts, held] if held is not None else parts), held is not None)


def held_box(grasp: Grasp, size: Vector3) -> OrientedBox:
    """A held box in the flange's frame."""
    return OrientedBox(grasp.flange_from_box, size)
