"""The scale of depths, from planes whose places are known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from marker_views import layout_of, mount_of

from depal.perception.calibration import Calibration, DepthScale
from depal.perception.calibration.finding import expected
from depal.perception.calibration.planes import PlaneDepth, merged, plane_depth
from depal.perception.calibration.scaling import scale_of
from depal.perception.calibration.surfaces import surface_of

SCALES = st.floats(0.98, 1.02)
DEPTHS = st.lists(st.floats(0.8, 4.0), min_size=2, max_size=9)


def plane(true: float, scale: float, offset: float = 0.0, error: float = 0.001) -> PlaneDepth:
    """A plane as a camera with this scale and offset measures it."""
    return PlaneDepth((true - offset) / scale, true, error)


@given(SCALES, DEPTHS)
def test_exact_planes_give_the_exact_scale(scale: float, depths: list[float]) -> None:
    """And no offset."""
    found = scale_of([plane(depth, scale) for depth in depths])
    assert found.scale == pytest.approx(scale, abs=1e-9)
    assert (found.offset, found.planes) == (0.0, len(depths))


@given(SCALES, st.floats(0.01, 0.05) | st.floats(-0.05, -0.01))
def test_an_offset_is_told_from_a_scale_where_depths_differ(scale: float, offset: float) -> None:
    """And taken for a scale where they do not, for a scale is what cameras have."""
    far = scale_of([plane(depth, scale, offset) for depth in (1.0, 1.5, 2.0, 2.5, 3.0)])
    assert far.scale == pytest.approx(scale, abs=1e-6)
    assert far.offset == pytest.approx(offset, abs=1e-6)
    near = scale_of([plane(depth, scale, offset) for depth in (2.0, 2.1, 2.2)])
    assert near.offset == 0.0
    assert near.scale == pytest.approx(scale + offset / 2.1, abs=0.003)


@given(SCALES, st.integers(0, 6), st.floats(0.02, 0.3))
def test_one_plane_that_is_out_of_place_counts_little(scale: float, which: int, off: float) -> None:
    """Less than two of its errors, however far it is."""
    planes = [plane(1.2 + 0.05 * number, scale) for number in range(7)]
    wrong = planes[which]
    planes[which] = PlaneDepth(wrong.measured, wrong.true + off, wrong.error)
    assert scale_of(planes).scale == pytest.approx(scale, abs=0.002)


def test_the_error_covers_what_noise_does() -> None:
    """In 95 of 100 draws the scale is within three of its errors."""
    random, scale = np.random.default_rng(1), 1.004
    within = 0
    for _ in range(100):
        planes = []
        for depth in (1.4, 1.4, 1.5, 2.9, 3.1, 3.2):
            error = 0.0008 * depth**2
            true = plane(depth, scale, error=error)
            noisy = true.measured + random.normal(0.0, error)
            planes.append(PlaneDepth(noisy, depth, error))
        found = scale_of(planes)
        middle = 1.5 + found.offset
        apart = found.scale * middle + found.offset - scale * middle
        within += abs(apart) <= 3 * found.error * middle + 1e-9
    assert within >= 95


def test_without_planes_the_scale_stays_one() -> None:
    """And its error says that nothing is known."""
    assert scale_of([]) == DepthScale()
    assert DepthScale().error == float("inf")


@settings(max_examples=5)
@given(SCALES, st.sampled_from(["front", "top"]), st.integers(0, 1 << 32))
def test_planes_are_measured_as_they_are_drawn(scale: float, camera: str, seed: int) -> None:
    """An ideal floor and nothing else, with noise and holes: each floor plane has the scale."""
    layout, mount = layout_of(), mount_of(camera)
    known = Calibration.nominal(mount)
    width, height = mount.depth_size
    (fx, _, cx), (_, fy, cy), _ = known.depth_k
    turn = np.array(mount.cell_from_camera.rotation)
    x, y = np.meshgrid((np.arange(width) - cx) / fx, (np.arange(height) - cy) / fy)
    down = turn[2, 0] * x + turn[2, 1] * y + turn[2, 2]
    with np.errstate(divide="ignore"):
        true = np.where(down < -0.05, -mount.cell_from_camera.translation[2] / down, 0.0)
    random = np.random.default_rng(seed)
    noisy = true / scale + 0.004 * true**2 * random.standard_normal(true.shape)
    depth = np.where(random.random(true.shape) < 0.2, 0.0, noisy).astype(np.float32)
    there = expected(layout.fiducials, known.colour_k, mount.colour_size, mount.cell_from_camera)
    flat = [
        one
        for one in layout.fiducials
        if one.id in there and one.cell_from_marker.translation[2] < 0.02
    ]
    assert len(flat) >= 3
    for one in flat:
        surface = surface_of(one, ())
        found = plane_depth(depth, known.depth_k, mount.cell_from_camera, surface)
        assert found is not None
        assert found.true / found.measured == pytest.approx(scale, abs=0.002)
        assert found.error < 0.005
        assert merged([found, found]).measured == pytest.approx(found.measured)


@given(SCALES, st.floats(0.0, 3.0))
def test_depths_of_pixels_beside_are_no_scale(scale: float, beside: float) -> None:
    """Slanted planes that are told nearer by the same number of pixels leave the scale alone."""
    planes = [plane(2.9, scale), plane(3.1, scale), plane(3.0, scale)]
    for true, slant in ((1.4, 0.003), (1.5, 0.003), (1.4, 0.0035)):
        told = plane(true, scale)
        planes.append(PlaneDepth(told.measured - beside * slant / scale, true, 0.001, slant))
    assert scale_of(planes).scale == pytest.approx(scale, abs=5e-4)


def test_the_surface_at_a_marker_is_the_floor_a_fixtures_face_or_its_plate() -> None:
    """The floor around a flat one with a hole for its plate, the whole beam behind one on it."""
    layout = layout_of()
    by_id = {one.id: one for one in layout.fiducials}
    floor = surface_of(by_id[0], layout.fixtures)
    assert floor.hole is not None
    assert np.ptp(floor.corners, axis=0) == pytest.approx([0.51, 0.51, 0.0])
    assert floor.corners[:, 2] == pytest.approx(0.0)
    beam = surface_of(by_id[5], layout.fixtures)
    assert np.ptp(beam.corners, axis=0) == pytest.approx([0.0, 1.84, 0.26], abs=1e-9)
    assert beam.outward == pytest.approx([-1.0, 0.0, 0.0])
    assert np.array_equal(beam.corners, surface_of(by_id[7], layout.fixtures).corners)
    plate = surface_of(by_id[5], ())
    assert np.ptp(plate.corners, axis=0) == pytest.approx([0.0, 0.24, 0.24], abs=1e-9)
