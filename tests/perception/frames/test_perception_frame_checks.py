"""Frames that must not be used are named; good ones have no finding."""

import math
from dataclasses import replace

import numpy as np
import pytest
from marker_views import cases, frame_of, layout_of, mount_of

from depal.cell.files import SHIPPED
from depal.domain import CellLayout, PalletStand
from depal.geometry import Matrix3, Pose
from depal.perception.frames import problems_of
from depal.ports import Frame
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import CellScene
from depal.simulation.scenes.scene import parked

CAMERAS = ("front", "top")


def lit(frame: Frame, factor: float) -> Frame:
    """The same picture in more or less light."""
    colour = np.clip(frame.colour * factor, 0, 255).astype(np.uint8)
    return replace(frame, colour=colour)


def zoomed(k: Matrix3, factor: float) -> Matrix3:
    """Intrinsics of a longer lens."""
    (fx, _, cx), (_, fy, cy), last = k
    return ((fx * factor, 0.0, cx), (0.0, fy * factor, cy), last)


def told(frame: Frame, camera: str, **known: object) -> tuple[str, ...]:
    """What is said about a frame of the default cell."""
    return problems_of(frame, layout_of(), mount_of(camera), **known)  # type: ignore[arg-type]


def taken(layout: CellLayout, camera: str) -> Frame:
    """A picture of another cell by a camera that stands as in the default cell."""
    return CameraModel(CellScene(layout, ()), mount_of(camera), 5).frame(parked(layout, ()), 0.0, 0)


def without_pallet(layout: CellLayout) -> CellLayout:
    """The same with its pallet out of sight."""
    stand = replace(layout.pallet.cell_from_pallet, translation=(40.0, 40.0, 0.144))
    return replace(layout, pallet=PalletStand(stand, layout.pallet.size))


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("share", [1.0, 0.4, 0.1, 0.0])
def test_good_frames_have_no_finding(camera: str, share: float) -> None:
    """With the highest load, with some of it, and with an empty pallet."""
    assert told(frame_of(camera, share=share), camera) == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED[1:])
@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("share", [1.0, 0.1])
def test_good_frames_of_other_cells_have_none_either(name: str, camera: str, share: float) -> None:
    """Where the pallet stands askew, too."""
    frame = frame_of(camera, share=share, name=name)
    assert problems_of(frame, layout_of(name), mount_of(camera, name)) == ()


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("factor", [0.7, 1.3])
def test_more_or_less_light_is_no_finding(camera: str, factor: float) -> None:
    """By 30 %."""
    assert told(lit(frame_of(camera), factor), camera) == ()


@pytest.mark.parametrize("camera", CAMERAS)
def test_pictures_that_show_nothing_are_named(camera: str) -> None:
    """Black, overexposed, one colour, no depth: each by its name, and nothing that follows."""
    frame = frame_of(camera)
    for bad, name in (
        (lit(frame, 0.05), "black: 95 % of the colour picture is darker than "),
        (lit(frame, 2.5), "overexposed: "),
        (
            replace(frame, colour=np.full_like(frame.colour, 128)),
            "blank: the colour picture is 128",
        ),
        (replace(frame, depth=np.zeros_like(frame.depth)), "blind: 0.0 % of the depth picture"),
    ):
        (finding,) = told(bad, camera)
        assert finding.startswith(name)
        assert "expected" in finding


def test_a_frame_that_comes_again_is_frozen() -> None:
    """Byte for byte, whatever its stamp; a new picture of the same scene is not."""
    frame, later = frame_of("top"), frame_of("top", 1)
    (finding,) = told(replace(frame, taken=3.0), "top", previous=frame)
    assert finding == (
        "frozen: the frame of 3.0 s is that of 0.0 s byte for byte, expected other noise"
    )
    assert told(later, "top", previous=frame, now=later.taken + 0.1) == ()


def test_an_old_frame_is_stale() -> None:
    """By the one before, and by the clock."""
    frame, later = frame_of("top"), frame_of("top", 1)
    (finding,) = told(frame, "top", previous=later)
    assert finding.startswith("stale: the frame was taken at 0.0 s, expected later than")
    (finding,) = told(frame, "top", now=9.0)
    assert finding == "stale: the frame is 9.0 s old, expected 2 s or less"


@pytest.mark.parametrize("camera", CAMERAS)
def test_wrong_sizes_are_named(camera: str) -> None:
    """Of either picture."""
    frame = frame_of(camera)
    small = np.ascontiguousarray(frame.colour[::2, ::2])
    (finding,) = told(replace(frame, colour=small), camera)
    assert finding.startswith(f"size: the colour picture is {small.shape[1]} x {small.shape[0]}")
    (finding,) = told(replace(frame, depth=frame.depth[:-1]), camera)
    assert finding.startswith("size: the depth picture is ")


@pytest.mark.parametrize("camera", CAMERAS)
def test_wrong_intrinsics_are_named(camera: str) -> None:
    """Those that the frame comes with, and those that the markers do not agree with."""
    frame = frame_of(camera)
    (finding,) = told(replace(frame, colour_k=zoomed(frame.colour_k, 1.05)), camera)
    assert finding.startswith("intrinsics: the colour picture comes with fx ")
    (finding,) = told(replace(frame, depth_k=zoomed(frame.depth_k, 0.9)), camera)
    assert finding.startswith("intrinsics: the depth picture comes with fx ")
    mount = mount_of(camera)
    view = 2 * math.atan(math.tan(mount.vertical_view / 2) / 1.03)
    longer = CameraModel(CellScene(layout_of(), ()), replace(mount, vertical_view=view), 5)
    other = longer.frame(parked(layout_of(), ()), 0.0, 0)
    lie = replace(other, colour_k=frame.colour_k, depth_k=frame.depth_k)
    (finding,) = told(lie, camera)
    assert finding.startswith("intrinsics: the markers fit a focal length of 14")


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("way", [(0.03, 0.0, 0.0), (0.0, -0.03, 0.0), (0.0, 0.0, 0.03)])
def test_a_camera_that_was_moved_is_named(camera: str, way: tuple[float, float, float]) -> None:
    """By three centimetres in any direction."""
    (finding,) = told(frame_of(camera, moved=Pose(way)), camera)
    assert finding.startswith("moved: by its ")
    assert finding.endswith(" mm off, expected at most 5 mm")


@pytest.mark.parametrize("camera", CAMERAS)
def test_a_picture_without_a_pallet_is_named(camera: str) -> None:
    """Markers or not, and another place altogether by its missing markers."""
    gone = without_pallet(layout_of())
    bare = replace(gone, fiducials=(), fixtures=())
    (finding,) = told(taken(gone, camera), camera)
    assert finding.startswith("pallet: ")
    frame = taken(bare, camera)
    (finding,) = told(frame, camera)
    assert finding.startswith("markers: 0 of the ")
    (finding,) = problems_of(frame, replace(layout_of(), fiducials=()), mount_of(camera))
    assert finding.startswith("pallet: ")


def test_loads_for_these_tests_are_high_and_low() -> None:
    """Else they would show less than they say."""
    assert max(case.shape.corners[:, 2].max() for case in cases("default")) > 1.6
    assert 1 <= len(cases("default", 0.1)) < 8
    assert cases("default", 0.0) == ()
