"""The port `Sight` over the cell's cameras: frames, their checks, perception, memory."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import Any

from depal.cell.pile import Pile
from depal.cell.sight.naming import perceived
from depal.domain import BoxId, DeliveryLine, Product
from depal.errors import DeviceError
from depal.geometry import OrientedBox
from depal.perception.detecting import Refuted
from depal.perception.faces import Face, Look
from depal.perception.memory import Memory, tally_of
from depal.perception.pictures import PictureBook
from depal.ports import Camera, Clock, Frame, View

Perceive = Callable[
    [
        Sequence[Frame],
        tuple[DeliveryLine, ...] | None,
        PictureBook,
        Look | None,
        Refuted,
    ],
    Look,
]
"""From the frames of a look to the boxes in it, by what the note says, by the look before, and by
what is no box."""

Check = Callable[[Sequence[Frame], float], Sequence[str]]
"""What is wrong with the frames of a look that was taken at this time [s], in words."""

KEPT = 4
"""The frames of so many looks are kept: a box is read some looks after it was seen."""

FIRST, LATER = 1.2, 0.5
"""What computing is charged after the first look and after later ones [s]."""


Rest = Callable[[Sequence[Frame], Sequence[OrientedBox]], tuple[OrientedBox, ...]]
"""Solids where something stands in the frames of a look that none of these boxes explains."""


Compute = Callable[..., Awaitable[Look]]
"""Calls what perceives with its arguments: on the event loop, or beside it."""


async def on_the_loop(perceive: Perceive, *args: Any) -> Look:  # noqa: ANN401 - passed on
    """While it is computed, nothing else goes on: the same seed gives the same events."""
    return perceive(*args)


Learn = Callable[[PictureBook, Product, Sequence[Face], Sequence[Frame]], PictureBook]
"""A picture book with the faces of a box that turned out to be of a product."""


def no_problem(_frames: Sequence[Frame], _at: float) -> tuple[str, ...]:
    """A check that is content with everything."""
    return ()


def nothing_learned(
    book: PictureBook, _product: Product, _faces: Sequence[Face], _frames: Sequence[Frame]
) -> PictureBook:
    """The book as it was."""
    return book


@dataclass(frozen=True, slots=True)
class Eyes:
    """What makes boxes of frames.

    Attributes:
        perceive: finds the boxes.
        rest: finds what the boxes do not explain.
        check: finds what is wrong with the frames; nothing is made of frames that are.
        learn: extends the picture book.
    """

    perceive: Perceive
    rest: Rest
    check: Check = no_problem
    learn: Learn = nothing_learned


class CameraSight:
    """Looks with all cameras at once and remembers."""

    def __init__(
        self,
        cameras: Sequence[Camera],
        eyes: Eyes,
        book: PictureBook,
        note: tuple[DeliveryLine, ...] | None,
        clock: Clock,
        memory: Memory | None = None,
    ) -> None:
        """Has seen nothing yet.

        Args:
            cameras: of the cell, in its layout's order.
            eyes: what makes boxes of frames.
            book: of pictures.
            note: what the delivery promises, where that is known.
            clock: the loop's time.
            memory: names that were given in advance.
        """
        self._cameras, self._eyes, self.book = tuple(cameras), eyes, book
        self._note, self._clock = note, clock
        self._pile: Pile | None = None
        self._doubting = False
        self._covered: Callable[[], bool] = lambda: False
        self.memory = Memory() if memory is None else memory
        self._seen: deque[tuple[float, tuple[Frame, ...]]] = deque(maxlen=KEPT)
        self._spans: list[OrientedBox] = []
        self.last: Look | None = None
        self.spent: list[float] = []
        self.compute: Compute = on_the_loop

    def bind(self, pile: Pile, covered: Callable[[], bool]) -> None:
        """Who knows the rest.

        Args:
            pile: knows which boxes were taken.
            covered: whether the arm is before the pallet.
        """
        self._pile, self._covered = pile, covered

    async def look(self) -> View:
        """Looks; exposure and computing take the time that is charged for them.

        Raises:
            DeviceError: no picture came, or none that anything may be grasped on.
        """
        frames = await asyncio.gather(*(camera.take() for camera in self._cameras))
        taken = self._clock.now()
        await asyncio.sleep(FIRST if self.last is None else LATER)
        problems = self._eyes.check(frames, taken)
        if problems:
            raise DeviceError("; ".join(problems))
        self._forget_taken()
        before = None if self.last is None or self._doubting else self._believed()
        self._doubting = False
        expected = self._expected()
        denied = tuple(box.seen.shape for box in self.memory.denied)
        refuted = Refuted(denied, tuple(self._spans))
        look = await self.compute(self._eyes.perceive, frames, expected, self.book, before, refuted)
        self._seen.append((taken, tuple(frames)))
        self.last = look
        self.memory = self.memory.update(look, taken)
        return self._view(taken)

    def doubt(self) -> None:
        """Something is not as it looked: the next look takes nothing over from those before."""
        self._doubting = True

    def deny(self, name: BoxId) -> None:
        """What goes by this name is no box: the next look finds out what else it may be."""
        self.memory = self.memory.forgetting(name)
        self._doubting = True

    def part(self, span: OrientedBox) -> None:
        """No one box reaches over all of a flat place: the next look finds what does."""
        self._spans.append(span)
        self._doubting = True

    @property
    def frames(self) -> tuple[Frame, ...]:
        """Those of the last look; none before the first."""
        return self._seen[-1][1] if self._seen else ()

    def learn(self, name: BoxId, product: Product) -> None:
        """The reader has told what a box is: its faces go into the picture book.

        Args:
            name: of a box that was lifted off not long ago.
            product: what it is.
        """
        self._forget_taken()
        box = next((box for box, _ in self.memory.gone if box.name == name), None)
        frames = next((each for at, each in self._seen if box and at == box.last), None)
        if box is not None and frames is not None:
            self.book = self._eyes.learn(self.book, product, box.seen.faces, frames)

    def _view(self, taken: float) -> View:
        memory = self.memory
        rest = None
        if not self._covered():
            rest = self._eyes.rest(self.frames, [box.seen.shape for box in memory])
        return View(
            taken,
            tuple(perceived(box, self._note) for box in memory),
            remembered=True,
            hidden=memory.hidden,
            unsized=frozenset(box.name for box in memory if not box.seen.sized),
            moved=memory.moved,
            obstacles=rest,
        )

    def _forget_taken(self) -> None:
        for name, at in (self._pile.taken if self._pile is not None else {}).items():
            self.memory = self.memory.without(name, at)

    def _believed(self) -> Look:
        """What is still there of the looks before."""
        return Look(tuple(box.seen for box in self.memory))

    def _expected(self) -> tuple[DeliveryLine, ...] | None:
        """What the note promises and has not left yet."""
        if self._note is None or self._pile is None:
            return self._note
        unseen = tally_of(self._note, self._pile.left_as).unseen
        return tuple(
            DeliveryLine(line.product, unseen.get(line.product.gtin, 0)) for line in self._note
        )
