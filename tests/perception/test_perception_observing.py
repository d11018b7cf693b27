"""A look finds the boxes of a scene, and a later look what has changed since."""

import math
from dataclasses import replace
from unittest import mock

import numpy as np
import pytest

from depal.cell.files import shipped_cell
from depal.geometry import Pose
from depal.logistics import read_delivery
from depal.perception.calibration import calibrate
from depal.perception.faces import Face, Facing, Name
from depal.perception.locating import located
from depal.perception.observing import Known, Observation, Observer, rectangle_of
from depal.perception.rasters import Region
from depal.perception.recognition import gallery_of, identify, identity
from depal.perception.recognition.rectifying import rectified
from depal.perception.recognition.trust import shipped_trust
from depal.ports import Frame
from depal.simulation.imaging.photographs import book_of
from depal.simulation.scenes import Kind, Scene, Severity, scene

SEED = 4_001


@pytest.fixture(scope="module")
def seen() -> tuple[Scene, Observer, Known, Observation, list[Frame]]:
    """A partly unloaded pallet and a first look at it."""
    layout, delivery = shipped_cell(), read_delivery("dev-035")
    made = scene(delivery, layout, SEED, Severity.NORMAL, Kind.UNLOADED)
    frames = [
        calibrate([frame], layout.fiducials, layout.fixtures).applied(frame)
        for frame in made.frames
    ]
    products = tuple(line.product for line in made.note.lines)
    known = Known(products, gallery=gallery_of(book_of(products, SEED, 1.0), made.note.lines))
    observer = Observer(Region.above(layout.pallet))
    return made, observer, known, observer.look(frames, known), frames


@pytest.mark.slow
def test_most_boxes_are_found_where_they_stand(
    seen: tuple[Scene, Observer, Known, Observation, list[Frame]],
) -> None:
    """Every box that was found is one that is there; most of what counts is found."""
    made, _, _, observation, _ = seen
    counting = [box for box in made.truth.boxes if box.front.counts or box.top.counts]
    centres = np.array([box.shape.centre for box in made.truth.boxes])
    near = 0
    for box in observation.look.boxes:
        away = np.linalg.norm(centres - box.shape.centre, axis=1)
        near += bool(away.min() < 0.03)
        if box.gtin is not None:
            assert made.truth.boxes[int(away.argmin())].gtin == box.gtin
    assert near >= 0.8 * len(observation.look.boxes)
    assert near >= 0.8 * len(counting)


@pytest.mark.slow
def test_a_second_look_at_the_same_pile_takes_everything_over(
    seen: tuple[Scene, Observer, Known, Observation, list[Frame]],
) -> None:
    """Nothing has changed, so nothing is looked for."""
    _, observer, known, observation, frames = seen
    again = observer.look(frames, known, observation)
    assert set(again.faces[0]) == set(observation.faces[0])
    assert set(again.faces[1]) == set(observation.faces[1])


@pytest.mark.slow
def test_what_stood_where_something_has_gone_is_looked_for_anew(
    seen: tuple[Scene, Observer, Known, Observation, list[Frame]],
) -> None:
    """A face that is covered by something else is no longer there."""
    _, observer, known, observation, frames = seen
    gone = max(observation.faces[0], key=lambda face: face.size[0] * face.size[1])
    raster = observation.rasters[0]
    rectangle = rectangle_of(raster, gone)
    covered = []
    for frame in frames:
        camera_from_cell = frame.cell_from_camera.inverse
        points = [
            camera_from_cell.apply(
                raster.cell_from_raster.apply((float(u), float(v), rectangle.depth))
            )
            for u, v in rectangle.corners
        ]
        depth = frame.depth.copy()
        if all(point[2] > 0.5 for point in points):
            k = frame.depth_k
            columns = [k[0][0] * x / z + k[0][2] for x, _, z in points]
            rows = [k[1][1] * y / z + k[1][2] for _, y, z in points]
            part = (
                slice(max(math.floor(min(rows)), 0), max(math.ceil(max(rows)), 0)),
                slice(max(math.floor(min(columns)), 0), max(math.ceil(max(columns)), 0)),
            )
            depth[part] = np.where(depth[part] > 0.0, depth[part] + 0.25, 0.0)
        covered.append(replace(frame, depth=depth))
    again = observer.look(covered, known, observation)
    assert gone not in again.faces[0]
    assert all(face.facing is Facing.FRONT for face in again.faces[0])


@pytest.mark.slow
def test_a_name_is_read_where_the_face_is_and_not_where_it_was_found(
    seen: tuple[Scene, Observer, Known, Observation, list[Frame]],
) -> None:
    """A yaw that was wrong by two degrees is set right before what is not sure is read."""
    made, _, known, _, frames = seen
    assert known.gallery is not None
    sizes, turned = known.expected.faces(Facing.FRONT), math.radians(2.0)
    c, s = math.cos(turned), math.sin(turned)
    off = Pose((0.002, -0.002, 0.004), ((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c)))
    doubting = replace(shipped_trust(), limit=100.0)
    told, read = list[Name | None](), list[Name | None]()
    with mock.patch.object(identity, "shipped_trust", return_value=doubting):
        for box in made.truth.boxes:
            if not box.front.counts:
                continue
            found = Face(Facing.FRONT, box.front.cell_from_face @ off, box.front.size, 1.0)
            face = located(found, frames, sizes, known.gallery)
            patch = rectified(frames, Facing.FRONT, face.cell_from_face, face.size)
            there = None if patch is None else identify(patch, known.gallery, sized=True)
            told.append(face.name)
            read.append(there.name if there else None)
    # Of a face that has hardly moved the letters are those that were read.
    assert sum(a == b for a, b in zip(told, read, strict=True)) > len(told) / 2 > 3
