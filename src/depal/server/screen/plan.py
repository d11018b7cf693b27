"""The cell from above and from the front, as SVG: for browsers that cannot draw it in 3-D."""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from depal.domain import CellLayout
from depal.geometry import Vector3
from depal.server.cellstate import CellState, Solid
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.panels.marks import SHAPES, TINTS, Mark, marks_of
from depal.server.screen.posture import posture
from depal.server.screen.words import Words, place_name

SCALE = 100.0
"""Units of the drawing per metre."""

CEILING = 2.2
"""So high is the view from the front [m]."""

NEAR = 0.7
"""From here on the end of the arm is before the pallet [m]."""

ASIDE = 0.65
"""The view from the front is so wide to either side [m]."""

Point = tuple[float, float]
View = Callable[[Vector3], Point]


def from_above(point: Vector3) -> Point:
    """The cell's x goes up in the drawing, y to the left: as one sees it from behind the arm."""
    return -point[1] * SCALE, -point[0] * SCALE


def from_front(point: Vector3) -> Point:
    """As the arm sees the pallet: y to the left, z up."""
    return -point[1] * SCALE, -point[2] * SCALE


@dataclass(frozen=True, slots=True)
class Drawn:
    """A box to draw.

    Attributes:
        name: beside its mark.
        solid: where it stands.
        mark: what it is.
    """

    name: str
    solid: Solid
    mark: Mark


def corners_of(solid: Solid) -> tuple[Vector3, ...]:
    """The eight corners, in the cell frame [m]: the lower four in a circle, then the upper."""
    c, s = math.cos(solid.yaw), math.sin(solid.yaw)
    hx, hy, hz = (edge / 2 for edge in solid.size)
    x, y, z = solid.centre
    ring = ((-hx, -hy), (hx, -hy), (hx, hy), (-hx, hy))
    return tuple(
        (x + c * a - s * b, y + s * a + c * b, z + up) for up in (-hz, hz) for a, b in ring
    )


def pile_of(state: CellState) -> tuple[Drawn, ...]:
    """The boxes on the pallet with their marks."""
    marks = marks_of(state)
    return tuple(Drawn(line.box, line.solid, marks[line.box]) for line in state.queue)


def plan(layout: CellLayout, state: CellState, words: Words) -> Markup:
    """The view from above."""
    (left, low), (right, high) = layout.floor
    frame = (
        f"{-high * SCALE:.0f} {-right * SCALE:.0f} "
        f"{(high - low) * SCALE:.0f} {(right - left) * SCALE:.0f}"
    )
    boxes = sorted(pile_of(state), key=lambda drawn: drawn.solid.centre[2])
    parts = [
        *_ground(layout),
        *(_top(Drawn("", s.solid, Mark.PLAIN), from_above, "standing") for s in state.standing),
        *(_top(drawn, from_above, "box") for drawn in boxes),
        *_names(layout, words),
        *_arm(layout, state, from_above),
        *(_sign(drawn, from_above) for drawn in boxes),
    ]
    return _drawing(parts, frame, words("view.plan"))


def elevation(layout: CellLayout, state: CellState, words: Words) -> Markup:
    """The view from the arm to the pallet."""
    stand = layout.pallet
    length, _, deck = stand.size
    frame = f"-75 {-CEILING * SCALE:.0f} 150 {(CEILING + 0.1) * SCALE:.0f}"
    boxes = sorted(pile_of(state), key=lambda drawn: -drawn.solid.centre[0])
    left, top = from_front((0.0, length / 2, 0.0))
    parts = [
        tag("line", x1=-75, y1=0, x2=75, y2=0, cls="floor"),
        tag("rect", x=left, y=top - deck * SCALE, width=length * SCALE, height=deck * SCALE,
            cls="pallet"),
        *(_front(drawn) for drawn in boxes),
        *(_sign(drawn, from_front) for drawn in boxes),
        _tool(layout, state),
    ]  # fmt: skip
    return _drawing(parts, frame, words("view.elevation"))


def _drawing(parts: Iterable[Markup | None], frame: str, name: str) -> Markup:
    return tag("svg", *parts, viewBox=frame, role="img", aria_label=name)


def _ground(layout: CellLayout) -> Iterator[Markup]:
    (left, low), (right, high) = layout.floor
    x, y = from_above((right, high, 0.0))
    yield tag("rect", x=x, y=y, width=(high - low) * SCALE, height=(right - left) * SCALE,
              cls="floor")  # fmt: skip
    length, width, _ = layout.pallet.size
    pallet = layout.pallet.cell_from_pallet
    ring = ((0.0, 0.0, 0.0), (length, 0.0, 0.0), (length, width, 0.0), (0.0, width, 0.0))
    yield tag("polygon", points=_points(map(pallet.apply, ring), from_above), cls="pallet")
    for storage in layout.storages:
        across, deep, _ = storage.size
        corners = tuple(
            (a, b, 0.0)
            for a, b in ((0.0, -across / 2), (deep, -across / 2), (deep, across / 2),
                         (0.0, across / 2))
        )  # fmt: skip
        pose = storage.cell_from_storage
        yield tag("polygon", points=_points(map(pose.apply, corners), from_above), cls="storage")


def _names(layout: CellLayout, words: Words) -> Iterator[Markup]:
    for storage in layout.storages:
        x, y = from_above(storage.cell_from_storage.apply((storage.size[1] / 2, 0.0, 0.0)))
        yield tag("text", place_name(storage.id, words), x=round(x), y=round(y) + 5, cls="name")


def _points(corners: "Iterator[Vector3] | map[Vector3]", view: View) -> str:
    return " ".join(f"{x:.0f},{y:.0f}" for x, y in map(view, corners))


def _look(mark: Mark) -> str:
    tint = TINTS[mark]
    wide = 2 if mark is Mark.PLAIN else 5
    dashes = ";stroke-dasharray:8 5" if mark is Mark.BLOCKER else ""
    return f"fill:{tint.fill};stroke:{tint.line};stroke-width:{wide}{dashes}"


def _top(drawn: Drawn, view: View, cls: str) -> Markup:
    upper = iter(corners_of(drawn.solid)[4:])
    return tag("polygon", points=_points(upper, view), style=_look(drawn.mark), cls=cls)


def _front(drawn: Drawn) -> Markup:
    seen = [from_front(corner) for corner in corners_of(drawn.solid)]
    left, right = min(x for x, _ in seen), max(x for x, _ in seen)
    top, bottom = min(y for _, y in seen), max(y for _, y in seen)
    return tag("rect", x=round(left), y=round(top), width=round(right - left),
               height=round(bottom - top), style=_look(drawn.mark), cls="box")  # fmt: skip


def _sign(drawn: Drawn, view: View) -> Markup | None:
    if drawn.mark is Mark.PLAIN:
        return None
    x, y = view(drawn.solid.centre)
    word = f"{SHAPES[drawn.mark]} {drawn.name}"
    return tag("text", word, x=round(x), y=round(y) + 7, cls="sign",
               style=f"fill:{TINTS[drawn.mark].text}")  # fmt: skip


def _arm(layout: CellLayout, state: CellState, view: View) -> Iterator[Markup]:
    poses = posture(layout.robot, state.joints)
    spine = [view(pose.origin) for pose in poses]
    points = " ".join(f"{x:.0f},{y:.0f}" for x, y in spine)
    yield tag("polyline", points=points, cls="arm")
    x, y = spine[-1]
    yield tag("circle", cx=round(x), cy=round(y), r=11, cls="tool")
    if state.held is not None:
        yield tag("text", state.held, x=round(x) + 16, y=round(y) - 10, cls="held")


def _tool(layout: CellLayout, state: CellState) -> Markup | None:
    """The end of the arm, where it is before the pallet: the arm itself would hide the boxes."""
    flange = posture(layout.robot, state.joints)[-1].origin
    if flange[0] < NEAR or abs(flange[1]) > ASIDE:
        return None
    x, y = from_front(flange)
    return tag("circle", cx=round(x), cy=round(y), r=11, cls="tool")


def both(layout: CellLayout, state: CellState, words: Words) -> Markup:
    """Plan and elevation side by side, each with its name."""
    drawn = (("view.plan", plan), ("view.elevation", elevation))
    return joined(
        tag("figure", draw(layout, state, words), tag("figcaption", words(key)))
        for key, draw in drawn
    )
