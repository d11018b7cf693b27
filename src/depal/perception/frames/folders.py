"""Frames in folders: `color.png`, `depth.png`, `frame.json`, `masks/*.png`."""

from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from depal.errors import FrameError, Problem
from depal.perception.frames.description import (
    NAME,
    Description,
    description_of,
    implausible,
    text_of,
)
from depal.perception.frames.recorded import RecordedFrame

COLOUR, DEPTH, MASKS = "color.png", "depth.png", "masks"
"""Names in a frame's folder."""

UNIT = 0.0001
"""Of one count in the depth pictures that are written [m]: the farthest is 6.55 m."""

_MOST = 0xFFFF
_PNG = "a PNG picture"
_LARGEST = 16
"""No `frame.json` is larger [MiB]."""


def read_frame_folder(path: Path) -> RecordedFrame:
    """The frame of a folder.

    Args:
        path: of the folder.

    Returns:
        The frame, depth in metres.

    Raises:
        FrameError: with everything that is wrong with it.
    """
    if not path.is_dir():
        what = "is no folder" if path.exists() else "there is no such folder"
        raise FrameError(str(path), [Problem("", what, f"a folder with {COLOUR}, {DEPTH}, {NAME}")])
    wrong = list[Problem]()
    found = _described(path, wrong)
    colour = _picture(path / COLOUR, COLOUR, wrong, cv2.IMREAD_COLOR)
    counts = _picture(path / DEPTH, DEPTH, wrong, cv2.IMREAD_UNCHANGED)
    if counts is not None and (counts.dtype != np.uint16 or counts.ndim != 2):  # noqa: PLR2004
        bits, channels = 8 * counts.dtype.itemsize, 1 if counts.ndim == 2 else counts.shape[2]  # noqa: PLR2004
        what = f"has {channels} channel(s) of {bits} bits"
        wrong.append(Problem(DEPTH, what, "one channel of 16 bits"))
        counts = None
    masks = _masks(path / MASKS, colour, wrong)
    if colour is not None and counts is not None:
        wrong += _sizes(colour, counts, found)
    if wrong or colour is None or counts is None or found.k is None or found.depth_unit is None:
        raise FrameError(str(path), wrong)
    return RecordedFrame(
        np.ascontiguousarray(colour[..., ::-1]),
        (counts * np.float64(found.depth_unit)).astype(np.float32),
        found.k,
        found.depth_k or found.k,
        found.cell_from_camera,
        found.sizes,
        masks,
        found.taken,
    )


def write_frame_folder(path: Path, frame: RecordedFrame, unit: float = UNIT) -> None:
    """Keeps a frame in a folder, which is made where it is missing.

    Depth comes back to half a unit; what is farther than 65,535 units counts as not measured.

    Args:
        path: of the folder; what stands there of an earlier frame is replaced.
        frame: what to keep.
        unit: of one count of depth [m].

    Raises:
        FrameError: the folder cannot be written.
    """
    counts = np.rint(frame.depth.astype(np.float64) / unit)
    counts = np.where(counts <= _MOST, counts, 0).astype(np.uint16)
    same = frame.depth_k == frame.colour_k and frame.depth.shape == frame.colour.shape[:2]
    found = Description(
        frame.colour_k,
        None if same else frame.depth_k,
        unit,
        frame.cell_from_camera,
        frame.sizes,
        frame.taken,
    )
    try:
        path.mkdir(parents=True, exist_ok=True)
        for old in sorted((path / MASKS).glob("*.png")):
            old.unlink()
        _write(path / COLOUR, np.ascontiguousarray(frame.colour[..., ::-1]))
        _write(path / DEPTH, counts)
        if frame.masks:
            (path / MASKS).mkdir(exist_ok=True)
        for index, mask in enumerate(frame.masks):
            _write(path / MASKS / f"{index:03d}.png", mask.astype(np.uint8) * 255)
        (path / NAME).write_text(text_of(found), encoding="utf-8")
    except OSError as error:
        what = f"cannot be written: {error.strerror}"
        raise FrameError(
            str(path), [Problem("", what, "a folder that can be written to")]
        ) from error


def frame_folders(path: Path) -> tuple[Path, ...]:
    """The frames in a folder, by name: the folder itself where it is one.

    Raises:
        FrameError: there is none.
    """
    if (path / NAME).is_file():
        return (path,)
    folders = sorted(one.parent for one in path.glob(f"*/{NAME}")) if path.is_dir() else []
    if not folders:
        what = "holds no frame" if path.is_dir() else "there is no such folder"
        expected = f"a folder with {NAME} in it, or with such folders in it"
        raise FrameError(str(path), [Problem("", what, expected)])
    return tuple(folders)


def _described(path: Path, wrong: list[Problem]) -> Description:
    file = path / NAME
    try:
        if file.stat().st_size > _LARGEST << 20:
            wrong.append(Problem(NAME, f"is larger than {_LARGEST} MiB", "a description"))
            return Description()
        found = description_of(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        wrong.append(Problem(NAME, "is missing", "an object with K and depth_unit"))
        return Description()
    except (OSError, UnicodeDecodeError) as error:
        wrong.append(Problem(NAME, f"cannot be read: {error}", "a JSON text in UTF-8"))
        return Description()
    wrong += found.problems
    return found


def _picture(
    file: Path, where: str, wrong: list[Problem], flags: int
) -> npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | None:
    try:
        data = np.frombuffer(file.read_bytes(), dtype=np.uint8)
    except FileNotFoundError:
        wrong.append(Problem(where, "is missing", _PNG))
        return None
    except OSError as error:
        wrong.append(Problem(where, f"cannot be read: {error.strerror}", _PNG))
        return None
    try:
        picture = cv2.imdecode(data, flags) if data.size else None
    except cv2.error:
        picture = None
    if picture is None:
        wrong.append(Problem(where, "is no picture that can be read", _PNG))
    return picture  # type: ignore[return-value]


def _masks(
    folder: Path,
    colour: npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | None,
    wrong: list[Problem],
) -> tuple[npt.NDArray[np.bool_], ...]:
    masks = list[npt.NDArray[np.bool_]]()
    for file in sorted(folder.glob("*.png")):
        where = f"{MASKS}/{file.name}"
        mask = _picture(file, where, wrong, cv2.IMREAD_UNCHANGED)
        if mask is None:
            continue
        if colour is not None and mask.shape[:2] != colour.shape[:2]:
            what = f"is {_measure(mask)}, {COLOUR} {_measure(colour)}"
            wrong.append(Problem(where, what, "the same size"))
        inside = mask.reshape(*mask.shape[:2], -1)[..., :3].max(axis=2) > 0
        masks.append(np.asarray(inside))
    return tuple(masks)


def _sizes(
    colour: npt.NDArray[np.uint8] | npt.NDArray[np.uint16],
    counts: npt.NDArray[np.uint8] | npt.NDArray[np.uint16],
    found: Description,
) -> list[Problem]:
    """What does not fit the sizes of the two pictures."""
    wrong = list[Problem]()
    if found.depth_k is None and counts.shape != colour.shape[:2]:
        what = f"is {_measure(counts)}, {COLOUR} {_measure(colour)}"
        wrong.append(Problem(DEPTH, what, f"the same size, or depth_K in {NAME}"))
    for key, k, picture in (("K", found.k, colour), ("depth_K", found.depth_k, counts)):
        why = implausible(k, (picture.shape[1], picture.shape[0])) if k is not None else ""
        if why:
            wrong.append(Problem(f"{NAME}, {key}", why, "intrinsics of this picture, in pixels"))
    return wrong


def _measure(picture: npt.NDArray[np.uint8] | npt.NDArray[np.uint16]) -> str:
    return f"{picture.shape[1]} x {picture.shape[0]}"


def _write(file: Path, picture: npt.NDArray[np.uint8] | npt.NDArray[np.uint16]) -> None:
    done, data = cv2.imencode(".png", picture, [cv2.IMWRITE_PNG_COMPRESSION, 2])
    if not done:
        raise OSError(0, "the picture cannot be encoded")
    file.write_bytes(data.tobytes())
