"""Everything that makes a frame unusable, in words. Nothing may be grasped on such a frame."""

from collections.abc import Iterator

from depal.domain import CameraMount, CellLayout
from depal.geometry import Matrix3
from depal.perception.calibration.calibration import Calibration
from depal.perception.calibration.checking import LIMIT, MarkerCheck, checked
from depal.perception.calibration.focal import focal_by_markers
from depal.perception.calibration.solving import FEWEST
from depal.perception.frames.exposure import age_problems, exposure_problems
from depal.perception.frames.standing_pallet import pallet_problems
from depal.ports import Frame

FOCAL = 0.01
"""A focal length that differs by a greater share is another lens's."""

CENTRE = 0.01
"""The same for the picture's centre, by the picture's width or height."""


def problems_of(
    frame: Frame,
    layout: CellLayout,
    mount: CameraMount,
    calibration: Calibration | None = None,
    previous: Frame | None = None,
    now: float | None = None,
) -> tuple[str, ...]:
    """What is wrong with a frame, each finding by its name and in one sentence.

    The names: `black`, `overexposed`, `blank`, `blind`, `frozen`, `stale`, `size`, `intrinsics`,
    `moved`, `markers`, `pallet`. What follows from another finding is not told.

    Args:
        frame: as the camera gave it: with its own pose and depths that are not scaled yet.
        layout: the cell: its pallet and its fiducials.
        mount: the camera.
        calibration: what is known of the camera; what the cell file says where None.
        previous: the frame before, of the same camera.
        now: the time [s].

    Returns:
        The findings; none where the frame can be used.
    """
    known = calibration or Calibration.nominal(mount)
    found = list(age_problems(frame, previous, now))
    sizes = list(_size_problems(frame, mount))
    shown = list(exposure_problems(frame))
    lenses = [] if sizes else list(_lens_problems(frame, known))
    found += [*sizes, *shown, *lenses]
    if sizes or lenses or shown:
        return tuple(found)
    if layout.fiducials:
        seen = checked(frame, layout.fiducials, known)
        markers = list(_marker_problems(frame, layout, known, seen))
        if markers:
            return (*found, *markers)
    return (*found, *pallet_problems(known.applied(frame), layout.pallet))


def _size_problems(frame: Frame, mount: CameraMount) -> Iterator[str]:
    pictures = (
        ("colour", frame.colour.shape, mount.colour_size),
        ("depth", frame.depth.shape, mount.depth_size),
    )
    for name, shape, (width, height) in pictures:
        if shape[:2] != (height, width):
            yield (
                f"size: the {name} picture is {shape[1]} x {shape[0]} pixels, "
                f"expected {width} x {height}"
            )


def _lens_problems(frame: Frame, known: Calibration) -> Iterator[str]:
    pictures = (
        ("colour", frame.colour_k, known.colour_k, frame.colour.shape),
        ("depth", frame.depth_k, known.depth_k, frame.depth.shape),
    )
    for name, k, wanted, shape in pictures:
        if _differs(k, wanted, (shape[1], shape[0])):
            yield (
                f"intrinsics: the {name} picture comes with {_lens(k)}, expected {_lens(wanted)}"
            )


def _differs(k: Matrix3, wanted: Matrix3, size: tuple[int, int]) -> bool:
    focals = any(abs(k[i][i] / wanted[i][i] - 1.0) > FOCAL for i in (0, 1))
    return focals or any(abs(k[i][2] - wanted[i][2]) > CENTRE * size[i] for i in (0, 1))


def _lens(k: Matrix3) -> str:
    return f"fx {k[0][0]:.0f} fy {k[1][1]:.0f} cx {k[0][2]:.0f} cy {k[1][2]:.0f}"


def _marker_problems(
    frame: Frame, layout: CellLayout, known: Calibration, seen: MarkerCheck
) -> Iterator[str]:
    if len(seen.seen) < FEWEST:
        yield (
            f"markers: {len(seen.seen)} of the {len(seen.expected)} markers are seen that this "
            f"camera has in view, expected {FEWEST} or more"
        )
        return
    if seen.residual <= LIMIT:
        return
    focal = focal_by_markers(frame.colour_k, layout.fiducials, known, seen)
    if focal is not None:
        yield (
            f"intrinsics: the markers fit a focal length of {focal:.0f} pixels, "
            f"expected {frame.colour_k[0][0]:.0f}"
        )
        return
    yield (
        f"moved: by its {len(seen.seen)} markers what the camera sees is "
        f"{1000 * seen.residual:.0f} mm off, expected at most {1000 * LIMIT:.0f} mm"
    )
