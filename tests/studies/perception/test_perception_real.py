"""Real frames: turned and under another light they show the same."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import FrameError
from depal.geometry import Pose
from depal.perception.faces import Face, Facing, Look
from depal.perception.frames import RecordedFrame, write_frame_folder
from depal.ports import Frame
from depal.simulation.imaging.lens import aimed
from depal.studies.bench.perception import Extent, bench_perception
from depal.studies.perception.real import Variant, judged, outline, score_frame, variants, varied

K = ((300.0, 0.0, 150.0), (0.0, 300.0, 130.0), (0.0, 0.0, 1.0))
FAR = 2.0
CARDS = ((60, 50, 40, 30), (150, 60, 50, 40), (220, 150, 60, 50), (100, 170, 70, 40))
"""Left, top, width and height of bright cards on a dark table [pixel]."""


def table() -> RecordedFrame:
    """Cards on a table that the camera looks straight down at."""
    colour = np.full((240, 320, 3), 40, dtype=np.uint8)
    masks = []
    for x, y, w, h in CARDS:
        mask = np.zeros((240, 320), dtype=np.bool_)
        mask[y : y + h, x : x + w] = True
        colour[mask] = 150
        masks.append(mask)
    depth = np.full((240, 320), FAR, dtype=np.float32)
    depth[100:140, 20:60] = FAR - 0.2
    pose = aimed((1.5, 0.001, FAR), (1.5, 0.0, 0.0))
    return RecordedFrame(colour, depth, K, K, pose, None, tuple(masks))


class BrightCards:
    """A perception that sees what is brighter than the table."""

    def __init__(self, *_told: object, **_sizes: object) -> None:
        """Needs to be told nothing."""

    def look(self, frames: Sequence[Frame]) -> Look:
        """Every bright patch as a face."""
        return Look((), faces=bright_cards(frames[0]))


def bright_cards(frame: Frame) -> tuple[Face, ...]:
    """Every bright patch as a face."""
    (fx, _, cx), (_, fy, cy), _ = frame.colour_k
    grey = frame.colour[..., 0].astype(float)
    bright = (grey > grey[grey > 0].mean() * 1.5).astype(np.uint8)
    faces = []
    for contour in cv2.findContours(bright, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0]:
        (u, v), (w, h), angle = cv2.minAreaRect(contour)
        turn = math.radians(angle)
        c, s = math.cos(turn), math.sin(turn)
        z = float(frame.depth[round(v), round(u)])
        at = Pose(
            ((u - cx) / fx * z, (v - cy) / fy * z, z),
            ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)),
        )
        size = ((w + 1) / fx * z, (h + 1) / fy * z)
        faces.append(Face(Facing.TOP, frame.cell_from_camera @ at, size, 0.9))
    return tuple(faces)


@pytest.mark.parametrize("variant", variants(), ids=str)
def test_what_is_there_is_found_in_every_variant(variant: Variant) -> None:
    """Pictures, depths, masks, intrinsics and pose turn together."""
    score = score_frame(table(), variant, BrightCards)
    assert (score.masks, score.found, score.false) == (4, 4, 0)


@given(st.floats(-45.0, 45.0))
@settings(max_examples=15)
def test_a_turn_leaves_everything_where_it_is_in_the_cell(angle: float) -> None:
    """The faces that are found in a turned picture stand where they stood."""
    plain, turned = (varied(table(), Variant(turn)).as_frame() for turn in (0.0, angle))
    before, after = (
        sorted(face.cell_from_face.translation for face in bright_cards(f)) for f in (plain, turned)
    )
    assert np.array(after) == pytest.approx(np.array(before), abs=0.012)


@given(st.floats(-45.0, 45.0))
@settings(max_examples=15)
def test_a_turned_picture_holds_all_of_the_old_one(angle: float) -> None:
    """Nothing is cut off at its edges."""
    frame = table()
    everything = np.ones((240, 320), dtype=np.bool_)
    turned = varied(replace(frame, masks=(everything,)), Variant(angle))
    assert int(turned.masks[0].sum()) == pytest.approx(240 * 320, rel=0.01)
    assert int((turned.depth > 0).sum()) == pytest.approx(240 * 320, rel=0.01)


def test_light_changes_the_picture_alone() -> None:
    """And stays within what a pixel can be."""
    frame = table()
    bright = varied(frame, Variant(light=2.0))
    assert int(bright.colour.max()) == 255
    assert np.array_equal(bright.depth, frame.depth)
    assert varied(frame, Variant()) is frame


def test_a_frame_without_a_pose_stays_without() -> None:
    """Its camera is the cell."""
    turned = varied(replace(table(), cell_from_camera=None), Variant(5.0))
    assert turned.cell_from_camera is None


def test_outlines_are_where_the_face_is_seen() -> None:
    """In the colour picture."""
    frame = table().as_frame()
    faces = bright_cards(frame)
    outlines = sorted(outline(face, frame).min(axis=0).round().tolist() for face in faces)
    expected = sorted([float(x), float(y)] for x, y, _, _ in CARDS)
    assert np.array(outlines) == pytest.approx(np.array(expected), abs=1.0)


def test_what_is_missed_and_what_is_made_up_is_counted() -> None:
    """One mask without an outline, one outline without a mask."""
    frame = table()
    x, y, w, h = CARDS[0]
    right = np.array([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], dtype=float)
    score = judged([right, right + 200.0, right * 1e6], frame.masks[:2], Variant())
    assert (score.found, score.false) == (1, 2)
    assert judged([], frame.masks, Variant()).found == 0


def test_folders_of_frames_are_measured_and_named(tmp_path: Path) -> None:
    """One frame or many; two of one name are told apart by their parents."""
    for parent in ("a", "b"):
        write_frame_folder(tmp_path / parent / "cards", table())
    extent = Extent((), 0, timed=0)
    result = bench_perception(extent, BrightCards, [tmp_path / "a", tmp_path / "b" / "cards"])
    assert list(result.frames) == ["a/cards", "b/cards"]
    figures = {figure.name: figure for figure in result.figures}
    assert [figure.value for figure in figures.values()] == [4, 0, 4] * 2
    assert figures["a/cards: found of 4"].target == 4
    assert figures["a/cards: found of 4, worst of 15 turns and lights"].target == 3


def test_a_frame_without_masks_is_refused_before_anything_is_measured(tmp_path: Path) -> None:
    """There is nothing to compare with."""
    write_frame_folder(tmp_path / "cards", replace(table(), masks=()))
    with pytest.raises(FrameError, match=r"cards: masks: there are no masks to compare with"):
        bench_perception(Extent(), BrightCards, [tmp_path])
