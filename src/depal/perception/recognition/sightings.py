"""Sightings: where on a raster which products' prints appear."""

from dataclasses import dataclass, replace

import numpy as np

from depal.perception.faces import Name, Raster, Rectangle
from depal.perception.rasters import Taken
from depal.perception.recognition.agreement import cosine_of
from depal.perception.recognition.features import Features, features_of
from depal.perception.recognition.patches import FINE, cut_out
from depal.perception.recognition.prints import OUTLINE, Gallery
from depal.perception.recognition.registration import Motion, brought_back, registered
from depal.perception.recognition.searching import Peak, peaks

NEAR = 0.03
"""Peaks whose middles are nearer are of one place, if their prints are as large [m]."""

ALIKE = 0.012
"""Prints whose edges differ by less are as large [m]."""

STEPS = 12
"""A print is laid over its place in so many steps at the most: it may be turned by 4 degrees."""

RIVALS = 8
"""So many prints are kept for one place."""

PLACES = 160
"""So many places are looked at closely."""

LEAST = 0.35
"""Cosine of a sighting, at least."""

TIE = 0.12
"""A print whose cosine is within this of the best one's stays its rival."""

MOVED = 0.035
"""A sighting that moved farther than this from its peak is of another place [m]."""


@dataclass(frozen=True, slots=True)
class Sighting:
    """A place on a raster where a print appears.

    Attributes:
        rectangle: the face, as large as the product's.
        name: the print that agrees best; never certain: a raster is too coarse for that.
        rivals: others that agree nearly as well there.
        seen: share of the face that a camera saw.
    """

    rectangle: Rectangle
    name: Name
    rivals: tuple[Name, ...] = ()
    seen: float = 1.0


def sightings(raster: Raster, gallery: Gallery, taken: Taken | None = None) -> tuple[Sighting, ...]:
    """Looks for every print everywhere.

    Args:
        raster: a front elevation or a top plan, in any step up to 4 mm.
        gallery: what may come.
        taken: what of the raster belongs to known faces: nothing is looked for there.

    Returns:
        Places with their prints, the best score first. They may overlap.
    """
    weights = raster.known.astype(np.float32)
    fine = features_of(raster.colour, weights, raster.step)
    outline = fine.thinned(max(round(FINE * OUTLINE / raster.step), 1)).flattened()
    found = peaks(outline, raster.facing, gallery)
    places = _places(found, outline.step)[:PLACES]
    if taken is not None and places:
        pixels = [_pixels(place[0], outline.step / raster.step, raster.step) for place in places]
        left = taken.leaves(np.array(pixels))
        places = [place for place, free in zip(places, left, strict=True) if free]
    seen = [_sighting(place, raster, fine, outline.step) for place in places]
    kept = [sighting for sighting in seen if sighting is not None]
    kept.sort(key=lambda sighting: -sighting.name.score)
    return tuple(_distinct(kept))


def _places(found: list[Peak], step: float) -> list[list[Peak]]:
    """Peaks of one place together, the best first; each product once."""
    places = list[list[Peak]]()
    for peak in found:
        for place in places:
            if _same_place(peak, place[0], step):
                gtins = {other.printed.product.gtin for other in place}
                if len(place) < RIVALS and peak.printed.product.gtin not in gtins:
                    place.append(peak)
                break
        else:
            places.append([peak])
    return places


def _same_place(one: Peak, other: Peak, step: float) -> bool:
    if abs(one.row - other.row) * step > NEAR or abs(one.column - other.column) * step > NEAR:
        return False
    (a, b), (c, d) = _size(one), _size(other)
    return abs(a - c) < ALIKE and abs(b - d) < ALIKE


def _pixels(peak: Peak, times: float, step: float) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of a peak's print on the raster [pixel].

    Args:
        peak: in pixels that are coarser.
        times: so many of the raster's pixels are one of those.
        step: edge of a pixel of the raster [m].
    """
    (width, height), x, y = _size(peak), peak.column * times, peak.row * times
    across, down = width / step / 2, height / step / 2
    return round(x - across), round(y - down), round(x + across), round(y + down)


def _size(peak: Peak) -> tuple[float, float]:
    """Width and height of a print as it lies [m]."""
    wide, high = peak.printed.size
    return (wide, high) if peak.quarter % 2 == 0 else (high, wide)


def _sighting(place: list[Peak], raster: Raster, fine: Features, step: float) -> Sighting | None:
    """A place looked at closely; the print that agrees best there says how large the face is."""
    rectangle, motion, names = _closely(place[0], place, raster, fine, step)
    winner = next(peak for peak in place if peak.printed.product.gtin == names[0].gtin)
    if winner is not place[0]:
        rectangle, motion, names = _closely(winner, place, raster, fine, step)
    x, y = motion.middle
    for _ in range(names[0].quarter):
        x, y = -y, x
    if names[0].score < LEAST or max(abs(x), abs(y)) > MOVED:
        return None
    moved = replace(
        rectangle, u=rectangle.u + x, v=rectangle.v + y, turn=rectangle.turn - motion.turn
    )
    depth, share = _depth(raster, moved)
    rivals = tuple(name for name in names[1:] if name.score > names[0].score - TIE)
    return Sighting(replace(moved, depth=depth), names[0], rivals, share)


def _closely(
    leader: Peak, place: list[Peak], raster: Raster, fine: Features, step: float
) -> tuple[Rectangle, Motion, list[Name]]:
    """The leader's print laid over its place, and how well all prints of the place agree there.

    Args:
        leader: whose size and pose are tried.
        place: all peaks of the place.
        raster: where it is.
        fine: the raster's features.
        step: edge of a pixel in which peaks are told [m].

    Returns:
        The leader's rectangle before it was laid, the motion, and the names, the best first.
    """
    middle = step / 2 - raster.step / 2
    width, height = _size(leader)
    u, v = leader.column * step + middle, leader.row * step + middle
    rectangle = Rectangle(u, v, width, height)
    seen = cut_out(fine, rectangle, FINE * 2).turned(-leader.quarter)
    motion = registered(seen, leader.printed.middle, Motion(), every=2, steps=STEPS)
    names = [_named(seen, peak, motion) for peak in place if peak.quarter == leader.quarter]
    names.sort(key=lambda name: -name.score)
    return rectangle, motion, names


def _named(seen: Features, peak: Peak, motion: Motion) -> Name:
    """How well one print of a place agrees."""
    printed = peak.printed
    back = brought_back(seen, motion, printed.middle.weights.shape)
    score = min(max(cosine_of(back, printed.middle), 0.0), 1.0)
    return Name(printed.product.gtin, printed.side, score, certain=False, quarter=peak.quarter)


def _depth(raster: Raster, rectangle: Rectangle) -> tuple[float, float]:
    """The usual depth of a rectangle's inner half, and the share of it all that is known."""
    (left, top), (right, bottom) = (
        np.clip(edge / raster.step, 0, raster.known.shape[::-1]).astype(int)
        for edge in (rectangle.corners.min(axis=0), rectangle.corners.max(axis=0))
    )
    share = float(raster.known[top : bottom + 1, left : right + 1].mean())
    down, across = (bottom - top) // 4, (right - left) // 4
    inner = raster.depth[top + down : bottom - down + 1, left + across : right - across + 1]
    measured = inner[np.isfinite(inner)]
    return (float(np.median(measured)) if measured.size else 0.0), share


def _distinct(ordered: list[Sighting]) -> list[Sighting]:
    """Without those that a better one of the same size covers."""
    kept = list[Sighting]()
    for sighting in ordered:
        if not any(_same(sighting.rectangle, other.rectangle) for other in kept):
            kept.append(sighting)
    return kept


def _same(one: Rectangle, other: Rectangle) -> bool:
    """Whether two rectangles are about the same."""
    near = max(abs(one.u - other.u), abs(one.v - other.v)) < NEAR
    sizes = (abs(one.width - other.width), abs(one.height - other.height))
    return near and max(sizes) < ALIKE
