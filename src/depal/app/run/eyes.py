"""What a simulated cell sees with when it looks with its cameras."""

from collections.abc import Sequence
from itertools import chain

from depal.app.run.values import Job
from depal.cell.sight import CameraSight, Eyes, extended_by, unexplained
from depal.domain import CameraMount, CellLayout, DeliveryLine, Product
from depal.executive.clock import Clock
from depal.geometry import OrientedBox
from depal.geometry.abreast import abreast
from depal.perception.calibration import Calibration, calibrate
from depal.perception.detecting import Refuted
from depal.perception.faces import Face, Look
from depal.perception.frames.checks import problems_of
from depal.perception.memory import Memory
from depal.perception.observing import Known, Observation, Observer
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region
from depal.perception.recognition import Gallery, gallery_of
from depal.ports import Camera, Frame
from depal.simulation.cell import SimulatedCell
from depal.simulation.imaging.photographs import book_of

KNOWN_SHARE = 0.9
"""Of the products of a simulated delivery so many have been photographed before."""


class Observing:
    """Perception of one cell: from the frames of a look to its boxes.

    Frames come as the cameras gave them; poses and depth scales are those of the calibration.
    """

    def __init__(self, layout: CellLayout, calibrations: Sequence[Calibration]) -> None:
        """Looks above the cell's pallet."""
        self._layout = layout
        self._calibrations = tuple(calibrations)
        self._observer = Observer(Region.above(layout.pallet))
        self._gallery: tuple[PictureBook, Gallery] | None = None
        self._last: Observation | None = None
        self._previous: tuple[Frame, ...] = ()

    def eyes(self) -> Eyes:
        """For the cell's sight."""
        return Eyes(self.perceive, self.rest, self.check, self.learn)

    def perceive(
        self,
        frames: Sequence[Frame],
        expected: tuple[DeliveryLine, ...] | None,
        book: PictureBook,
        before: Look | None,
        refuted: Refuted,
    ) -> Look:
        """The boxes that these frames show; what looks as before is taken over from there."""
        lines = tuple(expected or ())
        products = tuple(line.product for line in lines)
        known = Known(products, gallery=self._prints(book, lines), refuted=refuted)
        last = self._last if before is not None else None
        self._last = self._observer.look(self._true(frames), known, last)
        return self._last.look

    def rest(
        self, frames: Sequence[Frame], boxes: Sequence[OrientedBox]
    ) -> tuple[OrientedBox, ...]:
        """What none of these boxes explains."""
        return unexplained(self._true(frames), boxes, self._layout.pallet)

    def learn(
        self, book: PictureBook, product: Product, faces: Sequence[Face], frames: Sequence[Frame]
    ) -> PictureBook:
        """The book with the fronts of a box that the reader has told."""
        return extended_by(book, product, faces, self._true(frames))

    def check(self, frames: Sequence[Frame], at: float) -> tuple[str, ...]:
        """What is wrong with these frames."""
        before = self._previous or (None,) * len(frames)
        mounts = self._layout.cameras

        def told(k: int) -> list[str]:
            known = self._calibrations[k]
            problems = problems_of(frames[k], self._layout, mounts[k], known, before[k], at)
            return [f"camera {mounts[k].name}: {problem}" for problem in problems]

        found = abreast(told, range(len(frames)))
        self._previous = tuple(frames)
        return tuple(chain(*found))

    def _true(self, frames: Sequence[Frame]) -> list[Frame]:
        return [
            known.applied(frame) for known, frame in zip(self._calibrations, frames, strict=True)
        ]

    def _prints(self, book: PictureBook, lines: tuple[DeliveryLine, ...]) -> Gallery | None:
        """The book's prints, prepared once for each state of it."""
        if not book.entries:
            return None
        if self._gallery is None or self._gallery[0] is not book:
            self._gallery = (book, gallery_of(book, lines or None))
        return self._gallery[1]


def camera_sight(
    job: Job, cell: SimulatedCell, clock: Clock, cameras: Sequence[Camera] | None = None
) -> CameraSight:
    """The cameras of a simulated cell, calibrated, with perception and memory.

    Args:
        job: what is run.
        cell: the simulated one.
        clock: of the cell.
        cameras: in the layout's order; None for the cell's own.

    Raises:
        FrameError: a camera cannot be calibrated.
    """
    frames = [camera.frame(clock.now()) for camera in cell.cameras]
    memory = Memory(places=job.named)
    return sight_over(
        job.layout, job.told.lines, job.seed, cameras or cell.cameras, frames, clock, memory=memory
    )


def sight_over(
    layout: CellLayout,
    lines: tuple[DeliveryLine, ...],
    seed: int,
    cameras: Sequence[Camera],
    frames: Sequence[Frame],
    clock: Clock,
    *,
    memory: Memory | None = None,
) -> CameraSight:
    """Cameras, calibrated, with perception and memory.

    Args:
        layout: the cell.
        lines: of the note.
        seed: of the simulated store's product pictures.
        cameras: in the layout's order.
        frames: one of each, to calibrate by.
        clock: of the cell.
        memory: names that were given in advance.

    Raises:
        FrameError: a camera cannot be calibrated.
    """
    pairs = tuple(zip(layout.cameras, frames, strict=True))
    calibrations = abreast(lambda pair: _calibrated(layout, *pair), pairs)
    book = book_of([line.product for line in lines], seed, KNOWN_SHARE)
    eyes = Observing(layout, calibrations).eyes()
    return CameraSight(cameras, eyes, book, lines, clock, memory)


def _calibrated(layout: CellLayout, mount: CameraMount, frame: Frame) -> Calibration:
    """By the markers; a cell without any is taken as its file says."""
    if not layout.fiducials:
        return Calibration.nominal(mount)
    return calibrate([frame], layout.fiducials, layout.fixtures)
