"""The rasteriser against rays: every pixel sees what its ray meets first."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from imaging_rays import cast

from depal.geometry import OrientedBox, Pose
from depal.simulation.imaging.atlas import Atlas, AtlasBuilder
from depal.simulation.imaging.lens import Lens, Light, aimed
from depal.simulation.imaging.mesh import capsule, cuboid, joined, rectangle
from depal.simulation.imaging.raster import render

FLAT = Light(direct=0.0, above=1.0, below=1.0)


def plain_atlas() -> Atlas:
    """One colour."""
    builder = AtlasBuilder()
    builder.plain((200, 100, 50))
    return builder.build()


@st.composite
def heaps(draw: st.DrawFn) -> list[OrientedBox]:
    """Boxes all around the camera at the origin, some of them cut by its near plane."""
    at, size, turn = st.floats(-3, 3), st.floats(0.05, 1.5), st.floats(-math.pi, math.pi)
    boxes = []
    for _ in range(draw(st.integers(1, 6))):
        yaw = Pose.from_yaw((draw(at), draw(at), draw(at)), draw(turn))
        c, s = math.cos(tilt := draw(turn)), math.sin(tilt)
        boxes.append(
            OrientedBox(
                yaw @ Pose(rotation=((1, 0, 0), (0, c, -s), (0, s, c))),
                (draw(size), draw(size), draw(size)),
            )
        )
    return boxes


def lens_of() -> Lens:
    """At the origin, looking slightly down."""
    return Lens.looking(aimed((0.0, 0.0, 0.0), (1.0, 0.3, -0.2)), (48, 36), 1.1)


@given(heaps())
def test_every_pixel_sees_the_box_and_the_depth_that_its_ray_meets_first(
    boxes: list[OrientedBox],
) -> None:
    """Depth to 1e-6 m, over heaps that the near plane cuts."""
    lens, eye = lens_of(), np.zeros(3)
    boxes = [box for box in boxes if not _around(box)]
    mesh = joined([cuboid((1, 1, 1), (0,)).moved(Pose((-9.0, 0.0, 0.0)))])
    parts = [cuboid(b.size, (0,), i).moved(b.pose) for i, b in enumerate(boxes)]
    picture = render(joined([mesh, *parts]), plain_atlas(), lens)
    depth, part = cast(boxes, lens, eye)
    clear = np.isinf(depth)
    apart = np.abs(np.where(clear, 0.0, picture.depth) - np.where(clear, 0.0, depth))
    same = (picture.parts == part) & (clear | (apart < 1e-6))
    # A ray through an edge may fall on either side of it.
    assert np.count_nonzero(~same) <= same.size // 500


def _around(box: OrientedBox) -> bool:
    """Whether the camera stands in the box or its near plane may."""
    local = np.abs(np.array(box.pose.inverse.apply((0.0, 0.0, 0.0))))
    return bool(np.all(local < np.array(box.size) / 2 + 0.05))


@given(st.floats(-1.2, 1.2), st.floats(1.0, 4.0))
def test_a_texture_lies_in_perspective_on_a_slanted_face(yaw: float, away: float) -> None:
    """The colour ramps tell which texel each pixel took."""
    ramp = np.zeros((256, 256, 3), dtype=np.uint8)
    ramp[..., 0] = np.arange(256)[None, :]
    ramp[..., 1] = np.arange(256)[:, None]
    builder = AtlasBuilder()
    skin = builder.add(ramp)
    lens = Lens.looking(Pose(), (96, 64), 0.8)
    pose = Pose((0.0, 0.0, away)) @ Pose(
        rotation=((math.cos(yaw), 0, math.sin(yaw)), (0, 1, 0), (-math.sin(yaw), 0, math.cos(yaw)))
    )
    picture = render(rectangle(pose, (0.9, 0.7), skin), builder.build(), lens, FLAT)
    rows, columns = np.nonzero(picture.parts >= 0)
    (fx, fy), (cx, cy) = lens.focal, lens.centre
    z = picture.depth[rows, columns]
    points = np.stack(((columns - cx) / fx * z, (rows - cy) / fy * z, z), axis=1)
    local = (points - np.array(pose.translation)) @ np.array(pose.rotation)
    np.testing.assert_allclose(local[:, 2], 0.0, atol=1e-6)
    expected = (local[:, :2] / (0.9, 0.7) + 0.5) * 256 - 0.5
    seen = picture.colour[rows, columns, :2].astype(float)
    middle = np.all((expected > 12) & (expected < 243), axis=1)
    coarse = 256 / 0.9 * z[middle].max() / fx  # texels a pixel covers: coarser levels are blurred
    assert np.abs(seen[middle] - expected[middle]).max(initial=0.0) <= 2 + coarse


def test_faces_are_lit_by_how_they_face_the_light() -> None:
    """One side faces the light, the other stands across."""
    box = cuboid((0.4, 0.4, 0.4), (0,))
    light = Light(towards=(-1.0, 0.0, 0.0), direct=0.5, above=0.4, below=0.4)
    lens = Lens.looking(aimed((-2.0, -1.0, 0.0), (0.0, 0.0, 0.0)), (90, 60), 0.5)
    picture = render(box, plain_atlas(), lens, light)
    assert {int(value) for value in np.unique(picture.colour[picture.parts == 0][:, 0])} == {
        80,
        180,
    }


def test_a_capsule_is_as_thick_as_its_radius_says() -> None:
    """Seen from the side, and at its nearest."""
    lens = Lens.looking(aimed((-3.0, 0.0, 0.0), (0.0, 0.0, 0.0)), (300, 300), 0.5)
    picture = render(capsule((0, -0.3, 0), (0, 0.3, 0), 0.2, 0), plain_atlas(), lens)
    assert abs(float(picture.depth.min()) - 2.8) < 0.003
    rows, columns = np.nonzero(picture.parts == 0)
    wide, high = np.ptp(columns) + 1, np.ptp(rows) + 1
    assert abs(wide / high - 1.0 / 0.4) < 0.02


@settings(max_examples=5)
@given(heaps())
def test_the_same_scene_gives_the_same_bytes(boxes: list[OrientedBox]) -> None:
    """Nothing depends on anything but the scene."""
    mesh = joined([cuboid(b.size, (0,), i).moved(b.pose) for i, b in enumerate(boxes)])
    first, again = (render(mesh, plain_atlas(), lens_of()) for _ in range(2))
    assert first.colour.tobytes() == again.colour.tobytes()
    assert first.depth.tobytes() == again.depth.tobytes()


def test_an_empty_scene_shows_the_sky() -> None:
    """What stands behind the camera is not seen."""
    mesh = cuboid((0.1, 0.1, 0.1), (0,)).moved(Pose((-1.0, 0.0, 0.0)))
    picture = render(mesh, plain_atlas(), lens_of(), sky=(1, 2, 3))
    assert np.all(picture.colour == (1, 2, 3))
    assert np.all(np.isinf(picture.depth))
    assert np.all(picture.parts == -1)
