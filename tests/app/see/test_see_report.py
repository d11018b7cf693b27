"""`depal see` tells what was found, as JSON and over the picture."""

import io
import itertools
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given as for_all
from hypothesis import strategies as st
from rich.console import Console
from see_samples import GTIN, OTHER, frame, look

from depal.app.files import finite
from depal.app.see.given import Given, given
from depal.app.see.marked import direct, marked
from depal.app.see.report import panels_of, see_report
from depal.cell.files import find_cell
from depal.domain import Product
from depal.errors import DeliveryError, FrameError, SettingError
from depal.geometry import Pose
from depal.perception.faces import Look, Relation
from depal.perception.frames import write_frame_folder
from depal.perception.pictures import PictureBook, ProductPictures
from depal.perception.rasters import Region
from depal.simulation.imaging.lens import aimed
from depal.studies.drawing import save_figure

REGION = Region(Pose((1.2, 0.0, 0.2)), (1.0, 1.4, 1.0))


def one_frame(*, placed: bool = True) -> Given:
    """A frame from a folder, without a note."""
    frames = (frame().as_frame(),)
    return Given("here", ("",), frames, (placed,), None, None, PictureBook(), "", REGION)


def two_frames() -> Given:
    """The same twice, once black."""
    upper = replace(frame().as_frame(), colour=np.zeros((480, 640, 3), dtype=np.uint8))
    frames = (frame().as_frame(), upper)
    return replace(one_frame(), names=("front", "top"), frames=frames, placed=(True, True))


def test_every_detection_is_told_with_its_corners_and_its_name() -> None:
    """The fields of the contract."""
    fields = json.loads(json.dumps(finite(see_report(one_frame(), look(), 0.25).fields)))
    named, stray = fields["detections"][0], fields["detections"][-1]
    assert [face["name"] for face in fields["detections"]] == ["b1", "b2", "b2", "b3", "f1"]
    assert named["facing"] == "front"
    assert (named["gtin"], named["certain"], named["box"]) == (GTIN, True, 0)
    assert np.array(named["corners"]).shape == (4, 2)
    assert named["corners_cell"][0] == pytest.approx([1.6, 0.2, 0.5])
    assert named["size"] == [0.4, 0.2]
    assert (named["score"], named["visible"]) == (0.97, 1.0)
    assert (stray["box"], stray["gtin"], stray["certain"]) == (None, None, False)
    guessed = fields["detections"][1]
    assert (guessed["gtin"], guessed["certain"], guessed["facing"]) == (OTHER, False, "top")


def test_every_box_is_told_with_its_pose_and_how_sure_it_is() -> None:
    """Centre, size, yaw, sigma."""
    fields = see_report(one_frame(), look(), 0.25).fields
    box = fields["boxes"][2]  # type: ignore[index, call-overload]
    assert isinstance(box, dict)
    assert box["name"] == "b3"
    assert box["centre"] == [1.4, 0.3, 0.4]
    assert box["yaw"] == pytest.approx(0.02)
    assert box["sigma"] == pytest.approx({"x": 0.001, "y": 0.002, "z": 0.003, "yaw": 0.004})
    assert (box["gtin"], box["sized"]) == (None, False)
    assert fields["relations"] == [
        {"relation": "on_top", "upper": "b2", "lower": "b1", "probability": 0.99},
        {"relation": "occludes", "upper": "b3", "lower": "b1", "probability": 0.7},
    ]


@pytest.mark.parametrize(
    ("placed", "cell"), [(True, "as recorded"), (False, "derived from the dominant plane")]
)
def test_it_is_said_where_the_frame_of_the_boxes_comes_from(placed: object, cell: str) -> None:
    """A frame that does not know where it was taken from has no cell."""
    fields = see_report(one_frame(placed=bool(placed)), look(), 0.25).fields
    assert fields["cell"] == cell
    camera = fields["cameras"][0]  # type: ignore[index, call-overload]
    assert (camera["cell_from_camera"] is None) is not placed
    assert camera["size"] == [640, 480]


def test_a_table_has_a_line_for_each_box_and_each_stray_face() -> None:
    """With what it stands on, and the likeliest product in doubt."""
    out = Console(width=140, record=True, file=io.StringIO())
    for part in see_report(one_frame(), look(), 0.25).shown:
        out.print(part)
    text = out.export_text()
    for words in (GTIN, f"{OTHER} ?", "b1", "b3", "f1", "0.200 x 0.200 x 0.200 ?"):
        assert words in text
    assert "3 boxes seen by one camera, without pictures of products" in text


def test_the_title_says_how_many_boxes_are_named() -> None:
    """Where there are pictures to name them by."""
    product = Product(GTIN, "p", (0.3, 0.2, 0.2), 5.0)
    known = replace(one_frame(), book=PictureBook({GTIN: ProductPictures(product)}))
    assert see_report(known, look(), 0.25).shown[-1] == (
        "3 boxes seen by one camera, 1 of 3 named for certain"
    )
    assert see_report(known, Look(()), 0.25).shown[-1] == "No box seen by one camera"


def test_a_face_is_drawn_where_a_camera_sees_it_most_squarely() -> None:
    """Of two that see it alike the first."""
    seen = two_frames()
    down = aimed((1.6, 0.01, 2.5), (1.6, 0.0, 0.5))
    above = replace(seen.frames[1], cell_from_camera=down)
    faces = marked(look(), (seen.frames[0], above))
    assert {(face.face.facing.value, face.camera) for face in faces} == {("front", 0), ("top", 1)}
    assert {face.camera for face in marked(look(), seen.frames)} == {0}


@for_all(st.permutations(range(5)), st.integers(2, 5))
def test_only_direct_relations_are_drawn(names: list[int], count: int) -> None:
    """Of a tower each box stands on the next, whatever follows from that."""
    tower = names[:count]
    pairs = [(a, b) for i, a in enumerate(tower) for b in tower[i + 1 :]]
    kept = direct([Relation(a, b, 0.9) for a, b in pairs])
    assert [(r.upper, r.lower) for r in kept] == list(itertools.pairwise(tower))


def test_relations_are_drawn_where_both_boxes_are_seen() -> None:
    """Between the faces that show it best."""
    seen = one_frame()
    (panel,) = panels_of(seen, look(), marked(look(), seen.frames))
    assert [(mark.words[0], mark.top) for mark in panel.marks] == [
        ("b1  .97", False),
        ("b2  .88", True),
        ("b2  .97", False),
        ("b3  .97", False),
        ("f1  .97", False),
    ]
    assert panel.marks[0].words[1] == "098180"
    assert panel.marks[1].words[1] == "013116?"
    assert [(a.start, a.end, a.dotted) for a in panel.arrows] == [(2, 0, False), (3, 0, True)]


@pytest.mark.parametrize("found", [look(), Look(())])
@pytest.mark.parametrize("seen", [one_frame(), two_frames()], ids=["one", "two"])
def test_a_picture_is_drawn_of_any_look(tmp_path: Path, found: Look, seen: Given) -> None:
    """With many faces, and with none; the same bytes twice."""
    for name in ("a.png", "b.png"):
        report = see_report(seen, found, 0.25)
        assert report.draw is not None
        save_figure(report.draw(), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_folder_is_one_frame_or_all_of_one_look(tmp_path: Path) -> None:
    """With the sizes that any of them knows, each once."""
    sizes = ((0.3, 0.2, 0.1),)
    write_frame_folder(tmp_path / "front", replace(frame(), sizes=sizes))
    write_frame_folder(tmp_path / "top", replace(frame(), sizes=sizes))
    both, one = given(str(tmp_path)), given(str(tmp_path / "front"), "dev-035")
    assert (both.names, both.placed, both.sizes) == (("front", "top"), (True, True), sizes)
    assert both.note is None
    assert (one.names, one.noted) == (("",), "dev-035")
    assert one.note
    inside = given(str(tmp_path / "front"), cell="default")
    assert inside.region == Region.above(find_cell("default").pallet) != one.region


def test_frames_of_one_look_know_where_they_were_taken_from(tmp_path: Path) -> None:
    """One frame alone is levelled by what it shows; two would not fit together."""
    for name in ("front", "top"):
        write_frame_folder(tmp_path / name, replace(frame(), cell_from_camera=None))
    assert given(str(tmp_path / "top")).placed == (False,)
    with pytest.raises(FrameError, match="front, top do not know where they were taken from"):
        given(str(tmp_path))


@pytest.mark.slow
def test_the_simulated_cell_can_be_looked_at() -> None:
    """With its own note and pictures of its products; the same look for the same words."""
    first, second = (given("simulated:dev-035:7:hard") for _ in range(2))
    assert first.names == ("front", "top")
    assert first.noted == "dev-035"
    assert len(first.book.entries) > 0
    assert np.array_equal(first.frames[0].colour, second.frames[0].colour)
    assert np.array_equal(first.frames[0].depth, second.frames[0].depth)


@pytest.mark.parametrize(
    ("reference", "message"),
    [
        ("simulated:", "FRAME: 'simulated:' is no simulated look; expected simulated:DELIVERY"),
        ("simulated:dev-000:x", "FRAME: 'x' is no seed; expected a whole number"),
        ("simulated:dev-000:1:wild", "FRAME: unknown severity 'wild'; there is: easy, hard, nor"),
        ("simulated:dev-000:1:hard:9", "is no simulated look"),
    ],
)
def test_a_simulated_look_that_there_is_not_is_named(reference: str, message: str) -> None:
    """What, where, what was expected, what exists."""
    with pytest.raises(SettingError) as error:
        given(reference)
    assert message in str(error.value)


def test_what_cannot_be_read_is_one_error(tmp_path: Path) -> None:
    """A folder, a note."""
    with pytest.raises(FrameError, match="there is no such folder"):
        given(str(tmp_path / "nowhere"))
    with pytest.raises(DeliveryError):
        given(str(tmp_path), "nowhere.json")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"colour": np.zeros((480, 640, 3), dtype=np.uint8)}, "black: 95 % of the colour picture"),
        ({"colour": np.full((480, 640, 3), 255, dtype=np.uint8)}, "overexposed: 100 % of the"),
        ({"depth": np.zeros((480, 640), dtype=np.float32)}, "blind: 0.0 % of the depth picture"),
        ({"colour_k": ((9e3, 0.0, 320.0), (0.0, 9e3, 240.0), (0.0, 0.0, 1.0))}, "frame.json, K: "),
    ],
)
def test_a_frame_on_which_nothing_can_be_seen_is_refused(
    tmp_path: Path, change: dict[str, object], message: str
) -> None:
    """Black, overexposed, without depth, with the intrinsics of another lens."""
    write_frame_folder(tmp_path / "bad", replace(frame(), **change))  # type: ignore[arg-type]
    with pytest.raises(FrameError) as error:
        given(str(tmp_path / "bad"))
    assert str(tmp_path / "bad") in str(error.value)
    assert message in str(error.value)
    assert "expected" in str(error.value)
