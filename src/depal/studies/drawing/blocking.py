"""Fig. 5: which box waits for which, drawn over the boxes."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Rectangle

from depal.studies.drawing.free_place import Obstacles, free_place
from depal.studies.drawing.front import RULER, Face, SeenBox, around, face_of, rulers
from depal.studies.drawing.graph_layout import (
    Edge,
    Vertex,
    bend_of,
    covers_of,
    curve,
    direct,
    rows_of_depth,
    vertices_of,
)
from depal.studies.drawing.lettering import BODY, POINTS, SMALL, typeset, write
from depal.studies.drawing.palette import (
    ASKED,
    CASE_EDGE,
    CASE_FAR,
    CASES,
    GREY,
    IN_THE_WAY,
    INK,
    PAPER,
    blend,
    darker,
)
from depal.studies.drawing.sheet import Sheet, joined, sheet

RADIUS = 0.21
"""Of a vertex [in]."""

STEP = 0.5
"""How far what stands behind is moved to the right and up, per row of depth [in]."""

STAIRS = 1.9
"""How far all rows together are moved at the most [in]."""


RIM = 0.06
"""Around the picture, for the width of its lines [in]."""

LETTER = 0.075
"""The width of a digit of a score [in]."""

LINE_HEIGHT = 0.16
"""The height of a score [in]."""


def blocking_graph(
    boxes: Sequence[SeenBox],
    edges: Collection[Edge],
    requested: int,
    blockers: Collection[int],
    note: str = "",
) -> Figure:
    """The graph G over a group of boxes, T(b_r) of the requested one in green; Fig. 5.

    Args:
        boxes: the boxes; scores are shown where a box has them.
        edges: (b1, b2) where b2 lies on b1 or occludes it, as indices.
        requested: the index of the requested box.
        blockers: the indices of T(b_r); the requested box may be among them or not.
        note: the parameters of the run, for the caption.

    Returns:
        A figure of the boxes as the robot sees them; what stands behind is lighter and moved to
        the right and up. Arrows that follow from other arrows are left out.
    """
    green = frozenset(blockers) | {requested}
    asked = typeset(boxes[requested].label)
    arrows = direct(edges)
    paper = sheet(
        5.2,
        _finding(asked, len(green) - 1),
        "An arrow leads from a box to one that lies on it or occludes it. Green: the requested "
        f"{asked} and $T$({asked}), which inherits its priority. Dashed: hidden behind others.",
        joined(
            "After Fig. 5 and Eq. (2), section II-C",
            "arrows that follow from others are left out" if len(arrows) < len(set(edges)) else "",
            note,
        ),
    )
    scene = _scene(paper, boxes, arrows)
    _draw_cases(scene, requested)
    for edge in arrows:
        _draw_arrow(scene, edge, green=green.issuperset(edge))
    for index, box in enumerate(boxes):
        words, marked = typeset(box.label), index == requested
        _draw_vertex(scene, index, words, requested=marked, green=index in green)
    _draw_scores(scene, boxes, green)
    return paper.figure


@dataclass(frozen=True, slots=True)
class _Scene:
    """Everything that has its place.

    Attributes:
        axes: a bare picture in metres.
        inch: one inch of the sheet [m].
        rows: the row of depth of each box.
        faces: where each box is drawn [m].
        covers: for each box what hides parts of it.
        vertices: where each vertex is drawn.
        bends: how each arrow is bent, as a share of its length.
    """

    axes: Axes
    inch: float
    rows: list[int]
    faces: list[Face]
    covers: list[list[Face]]
    vertices: list[Vertex]
    bends: dict[Edge, float]


def _scene(paper: Sheet, boxes: Sequence[SeenBox], arrows: Collection[Edge]) -> _Scene:
    """Gives everything its place, as large as the sheet allows."""
    rows = rows_of_depth(boxes)
    step = min(STEP, STAIRS / max(*rows, 1))
    stairs = step * max(rows)
    load = around([face_of(box) for box in boxes])
    _, _, width, height = paper.whole
    scale = min(
        (width - RULER - RIM - stairs) / load.width, (height - RULER - RIM - stairs) / load.height
    )
    inch = 1.0 / scale
    faces = [face_of(box, row * step * inch) for box, row in zip(boxes, rows, strict=True)]
    whole, room, rim = around([*faces, load]), RULER * inch, RIM * inch
    window = (whole.left - room, whole.right + rim, whole.bottom - room, whole.top + rim)
    axes, _ = paper.picture(paper.whole, window)
    if not stairs:  # boxes that are moved aside fit no ruler
        rulers(axes, load, scale)
    covers = covers_of(faces, rows)
    vertices = vertices_of(faces, covers, RADIUS * inch)
    spots = [vertex.spot for vertex in vertices]
    bends = {edge: bend_of(edge, spots, RADIUS * inch) for edge in arrows}
    return _Scene(axes, inch, rows, faces, covers, vertices, bends)


def _finding(asked: str, count: int) -> str:
    """The title: how many boxes a request reaches."""
    if count == 0:
        return f"Nothing blocks the requested {asked}"
    if count == 1:
        return f"A request for {asked} raises the score of the one box that blocks it"
    return f"A request for {asked} raises the scores of the {count} boxes that block it"


def _draw_cases(scene: _Scene, requested: int) -> None:
    """The boxes as rectangles, the farthest first, then the rims of what is hidden."""
    far = max(*scene.rows, 1)
    for index in sorted(range(len(scene.faces)), key=lambda index: -scene.rows[index]):
        face, marked = scene.faces[index], index == requested
        share = scene.rows[index] / far
        for filled in (True, False) if scene.covers[index] else (True,):
            scene.axes.add_patch(
                Rectangle(
                    (face.left, face.bottom),
                    face.width,
                    face.height,
                    facecolor=blend(CASES[0], CASE_FAR, share) if filled else "none",
                    edgecolor=ASKED if marked else CASE_EDGE,
                    linewidth=(2.6 if marked else 1.1) if filled else 0.8,
                    linestyle="solid" if filled else (0, (4, 3)),
                    joinstyle="round",
                    zorder=(4 if marked and not scene.covers[index] else 2) if filled else 5,
                )
            )


def _draw_arrow(scene: _Scene, edge: Edge, *, green: bool) -> None:
    """An arrow between two vertices."""
    start, end = (scene.vertices[index].spot for index in edge)
    scene.axes.add_patch(
        FancyArrowPatch(
            start,
            end,
            arrowstyle="-|>",
            connectionstyle=f"arc3,rad={scene.bends[edge]}",
            mutation_scale=15,
            shrinkA=RADIUS * POINTS,
            shrinkB=RADIUS * POINTS + 1,
            color=ASKED if green else GREY,
            linewidth=2.2 if green else 1.3,
            zorder=8 if green else 7,
        )
    )


def _draw_vertex(scene: _Scene, index: int, words: str, *, requested: bool, green: bool) -> None:
    """A circle with a label; dashed where its box cannot be seen."""
    vertex = scene.vertices[index]
    scene.axes.add_patch(
        Circle(
            vertex.spot,
            RADIUS * scene.inch,
            facecolor=ASKED if requested else IN_THE_WAY if green else PAPER,
            edgecolor=darker(ASKED, 0.35) if requested else ASKED if green else GREY,
            linewidth=1.8 if green else 1.2,
            linestyle=(0, (3, 2)) if vertex.hidden else "solid",
            zorder=9,
        )
    )
    style = replace(BODY, size=12.0, across="center", colour=PAPER if requested else INK)
    write(scene.axes, vertex.spot, words, style)


def _draw_scores(scene: _Scene, boxes: Sequence[SeenBox], green: Collection[int]) -> None:
    """The score of each box that has one, where it is clear of everything else."""
    spots = np.array([vertex.spot for vertex in scene.vertices])
    curves = [curve(spots[start], spots[end], bend) for (start, end), bend in scene.bends.items()]
    lines = np.concatenate([np.empty((0, 2)), *curves])
    taken: list[Face] = []
    for index, box in enumerate(boxes):
        if box.after is None:
            continue
        words = f"{box.after:.2f}"
        if box.before is not None and f"{box.before:.2f}" != words:
            words = f"{box.before:.2f} \N{RIGHTWARDS ARROW} {words}"
        place, trouble = free_place(
            scene.faces[index],
            scene.vertices[index],
            (len(words) * LETTER * scene.inch, LINE_HEIGHT * scene.inch),
            scene.covers[index],
            Obstacles(spots, RADIUS * scene.inch, lines, taken),
        )
        taken.append(place)
        marked = index in green
        colour = darker(ASKED, 0.35) if marked else INK
        style = replace(SMALL, across="center", colour=colour, bold=marked, halo=trouble > 0)
        write(scene.axes, place.middle, words, style)
