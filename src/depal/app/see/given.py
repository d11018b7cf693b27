"""What `depal see` looks at: a recorded frame, or a look of the simulated cell."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from depal.app.run.inputs import cell_of
from depal.domain import DeliveryLine
from depal.errors import FrameError, Problem, SettingError, did_you_mean
from depal.geometry import Vector3
from depal.logistics import read_delivery
from depal.perception.book import read_book
from depal.perception.frames import frame_folders, read_frame_folder
from depal.perception.frames.exposure import exposure_problems
from depal.perception.ground import levelled, region_in
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region
from depal.ports import Frame
from depal.simulation.imaging.photographs import book_of
from depal.simulation.scenes import Severity, scene
from depal.studies.perception.scenes import calibrated

SIMULATED = "simulated:"
"""A reference that begins so means the simulated cell."""

FORM = f"{SIMULATED}DELIVERY[:SEED[:SEVERITY]]"


@dataclass(frozen=True, slots=True, eq=False)
class Given:
    """The input of one look.

    Attributes:
        source: how it was asked for.
        names: of the cameras; one empty name where there is one frame.
        frames: one of each camera.
        placed: by camera, whether the frame knows where it was taken from.
        note: what may stand there; None where nobody knows.
        sizes: edges of the boxes that may stand there; None where nobody knows [m].
        book: pictures of products; empty where there are none.
        noted: what the note is called; empty without one.
        region: where boxes are looked for.
    """

    source: str
    names: tuple[str, ...]
    frames: tuple[Frame, ...]
    placed: tuple[bool, ...]
    note: tuple[DeliveryLine, ...] | None
    sizes: tuple[Vector3, ...] | None
    book: PictureBook
    noted: str
    region: Region


def given(
    reference: str, note: str | None = None, book: Path | None = None, cell: str | None = None
) -> Given:
    """Reads everything that a look needs.

    Args:
        reference: a frame's folder, a folder of frames of one look, or a simulated look.
        note: a delivery whose note says what may stand there.
        book: the folder of a picture book.
        cell: the cell that recorded frames come from: boxes are looked for above its pallet.
            Without it they are looked for wherever something stands.

    Raises:
        InputError: something cannot be used.
    """
    lines = None if note is None else read_delivery(note).lines
    pictures = None if book is None else read_book(book)
    if reference.startswith(SIMULATED):
        return _simulated(reference, note, lines, pictures, cell or "default")
    folders = frame_folders(Path(reference))
    recorded = [read_frame_folder(folder) for folder in folders]
    for folder, frame in zip(folders, recorded, strict=True):
        _refuse_unusable(folder, frame.as_frame())
    sizes = [size for frame in recorded for size in frame.sizes or ()]
    placed = tuple(frame.cell_from_camera is not None for frame in recorded)
    if len(recorded) > 1 and not all(placed):
        unknown = [folder.name for folder, sure in zip(folders, placed, strict=True) if not sure]
        what = f"{', '.join(unknown)} do not know where they were taken from"
        expected = "cell_from_camera in every frame of a look, or one frame"
        raise FrameError(reference, [Problem("", what, expected)])
    frames = tuple(
        frame.as_frame() if sure else levelled(frame.as_frame())
        for frame, sure in zip(recorded, placed, strict=True)
    )
    region = region_in(frames) if cell is None else Region.above(cell_of(cell).pallet)
    return Given(
        reference,
        tuple(folder.name for folder in folders) if len(folders) > 1 else ("",),
        frames,
        placed,
        lines,
        tuple(dict.fromkeys(sizes)) or None,
        pictures or PictureBook(),
        note or "",
        region,
    )


def _refuse_unusable(folder: Path, frame: Frame) -> None:
    """A picture on which nothing can be seen is said to be one."""
    problems = [Problem("", finding) for finding in exposure_problems(frame)]
    if problems:
        raise FrameError(str(folder), problems)


def _simulated(
    reference: str,
    note: str | None,
    lines: tuple[DeliveryLine, ...] | None,
    book: PictureBook | None,
    cell: str,
) -> Given:
    """A look of a simulated cell; what stands there is known unless another note is named."""
    name, seed, severity = _parts(reference)
    delivery = read_delivery(name)
    layout = cell_of(cell)
    made = scene(delivery, layout, seed, severity)
    products = [line.product for line in delivery.lines]
    return Given(
        reference,
        tuple(camera.name for camera in layout.cameras),
        calibrated(made),
        (True,) * len(made.frames),
        made.note.lines if lines is None else lines,
        None,
        book_of(products, seed, known_share=1.0) if book is None else book,
        note or delivery.id,
        Region.above(layout.pallet),
    )


def _parts(reference: str) -> tuple[str, int, Severity]:
    """Delivery, seed and severity."""
    name, *rest = reference.removeprefix(SIMULATED).split(":")
    seed, severity = _filled(rest, ("0", Severity.NORMAL.value))
    if not name or len(rest) > 2:  # noqa: PLR2004 - seed and severity
        raise SettingError("FRAME", f"{reference!r} is no simulated look", FORM)
    if not (seed.isascii() and seed.isdigit()):
        raise SettingError("FRAME", f"{seed!r} is no seed", f"a whole number in {FORM}")
    if severity not in tuple(Severity):
        raise SettingError(
            "FRAME", f"unknown severity {severity!r}", exists=did_you_mean(severity, Severity)
        )
    return name, int(seed), Severity(severity)


def _filled(given: Sequence[str], defaults: tuple[str, str]) -> tuple[str, str]:
    first, second = (*given, *defaults[len(given) :])[:2]
    return first, second
