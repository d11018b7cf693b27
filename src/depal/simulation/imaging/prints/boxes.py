"""Boxes as triangles with their prints and labels."""

import math

from depal.geometry import Pose, Vector3
from depal.simulation.imaging.atlas import AtlasBuilder
from depal.simulation.imaging.mesh import Mesh, cuboid, face_pose, face_size, joined, rectangle
from depal.simulation.imaging.prints import artwork
from depal.simulation.imaging.prints.design import design_of
from depal.simulation.imaging.prints.label import label_for, label_image

UPRIGHT = range(4)
"""The sides that carry a label, as indices of `SIDES`."""

AHEAD = 0.0002
"""A label lies so far before its side [m]."""


class PrintedBoxes:
    """Prints cases; every product is drawn once."""

    def __init__(self, atlas: AtlasBuilder) -> None:
        """Prints into this atlas."""
        self._atlas = atlas
        self._done: dict[tuple[str, Vector3], Mesh] = {}

    def mesh(self, gtin: str, size: Vector3, part: int, name: str = "") -> Mesh:
        """A case around the origin, its label on all four upright sides.

        Args:
            gtin: its product.
            size: its edges along its own axes as it stands [m]; the longer of the two that lie
                is the product's length.
            part: its number in pictures.
            name: what the label calls it.

        Returns:
            Triangles in the box's own frame.
        """
        along, across, high = size
        if along >= across:
            return self._printed(gtin, size, name).of_part(part)
        quarter = Pose.from_yaw((0.0, 0.0, 0.0), math.pi / 2)
        return self._printed(gtin, (across, along, high), name).moved(quarter).of_part(part)

    def _printed(self, gtin: str, size: Vector3, name: str) -> Mesh:
        known = self._done.get((gtin, size))
        if known is None:
            known = self._done[gtin, size] = self._print(gtin, size, name)
        return known

    def _print(self, gtin: str, size: Vector3, name: str) -> Mesh:
        design, add = design_of(gtin), self._atlas.add
        ends = add(artwork.side(design, face_size(size, 0)))
        fronts = add(artwork.side(design, face_size(size, 2)))
        lid = add(artwork.top(design, face_size(size, 4)))
        floor = add(artwork.bottom(design, face_size(size, 5)))
        parts = [cuboid(size, (ends, ends, fronts, fronts, lid, floor))]
        for pair in (UPRIGHT[:2], UPRIGHT[2:]):
            label = label_for(face_size(size, pair[0]))
            if label is None:
                continue
            skin = add(label_image(gtin, name or f"{design.brand} {design.variety}", label))
            at = Pose((0.0, label.below, 0.0))
            parts += [
                rectangle(face_pose(size, side, AHEAD) @ at, label.size, skin) for side in pair
            ]
        return joined(parts)
