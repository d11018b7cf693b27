"""The port `Sight` over cameras: names, charges, bad frames, learning; perception is a script."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.pile import Pile
from depal.cell.sight import CameraSight, Eyes
from depal.cell.sight.naming import perceived, turned_like
from depal.domain import BoxId, DeliveryLine, Detection, Gtin, Product, Recognition
from depal.errors import DeviceError
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.detecting import Refuted
from depal.perception.faces import Face, Look, SeenBox
from depal.perception.memory import Memory, Remembered
from depal.perception.pictures import PictureBook, ProductPictures
from depal.ports import Frame, View

SIZE = (0.3, 0.4, 0.25)

NOTE = (DeliveryLine(Product(Gtin("a"), "a", (0.4, 0.3, 0.25), 4.0), 2),)

K = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def seen(y: float, gtin: str | None = None, *, sized: bool = True) -> SeenBox:
    """A box at the front."""
    shape = OrientedBox.upright((1.6, y, 0.3), SIZE)
    return SeenBox(shape, 0.9, np.eye(6) * 1e-5, (), Gtin(gtin) if gtin else None, sized)


@dataclass
class Camera:
    """Takes empty pictures; half a second each."""

    taken: int = 0

    async def take(self) -> Frame:
        """A picture."""
        await asyncio.sleep(0.5)
        self.taken += 1
        at = asyncio.get_running_loop().time()
        colour, depth = np.zeros((2, 2, 3), np.uint8), np.zeros((2, 2), np.float32)
        return Frame(at, colour, depth, K, K, Pose())


@dataclass
class Script:
    """What perception finds, look by look."""

    looks: Sequence[tuple[SeenBox, ...]]
    wrong: Sequence[str] = ()
    rest: tuple[OrientedBox, ...] = ()
    asked: list[tuple[DeliveryLine, ...] | None] = field(default_factory=list)
    before: list[Look | None] = field(default_factory=list)
    refuted: list[Refuted] = field(default_factory=list)
    learned: list[Gtin] = field(default_factory=list)

    def eyes(self) -> Eyes:
        """For the sight."""
        return Eyes(self._perceive, lambda *_: self.rest, lambda *_: self.wrong, self._learn)

    def _perceive(
        self,
        frames: Sequence[Frame],
        expected: tuple[DeliveryLine, ...] | None,
        book: PictureBook,
        before: Look | None,
        refuted: Refuted,
    ) -> Look:
        del frames, book
        self.refuted.append(refuted)
        self.asked.append(expected)
        self.before.append(before)
        return Look(self.looks[min(len(self.asked), len(self.looks)) - 1])

    def _learn(
        self, book: PictureBook, product: Product, faces: Sequence[Face], frames: Sequence[Frame]
    ) -> PictureBook:
        assert len(frames) == 2
        del faces
        self.learned.append(product.gtin)
        return PictureBook({**book.entries, product.gtin: ProductPictures(product)})


def sight_of(script: Script, memory: Memory | None = None, *, covered: bool = False) -> CameraSight:
    """Two cameras and this perception."""
    cameras = [Camera(), Camera()]
    sight = CameraSight(cameras, script.eyes(), PictureBook(), NOTE, LoopClock(), memory)
    sight.bind(Pile(), lambda: covered)
    return sight


def looked(sight: CameraSight, times: int = 1) -> tuple[list[View], float]:
    """So many looks, and the time they took."""

    async def look() -> tuple[list[View], float]:
        views = [await sight.look() for _ in range(times)]
        return views, asyncio.get_running_loop().time()

    return run_simulated(look())


def test_a_look_takes_its_exposure_and_what_is_charged_for_computing() -> None:
    """All cameras at once; the first look takes longer."""
    for looks, seconds in ((1, 0.5 + 1.2), (3, 3 * 0.5 + 1.2 + 2 * 0.5)):
        views, ended = looked(sight_of(Script([(seen(0.0),)])), looks)
        assert ended == pytest.approx(seconds)
        assert views[0].taken == pytest.approx(0.5)


def test_boxes_keep_their_names_and_places_that_were_named_in_advance_keep_theirs() -> None:
    """An empty memory with promised names is a memory."""
    memory = Memory(places=((BoxId("wanted"), (1.6, 0.0, 0.3)),))
    script = Script([(seen(0.0), seen(0.5, "a")), (seen(0.5, "a"), seen(0.001))])
    views, _ = looked(sight_of(script, memory), 2)
    for view in views:
        assert {box.id: type(box) for box in view.boxes} == {
            "wanted": Detection,
            "b1": Recognition,
        }
        assert view.remembered


def test_what_the_look_does_not_show_cannot_be_sized_or_explained_is_said() -> None:
    """So the cell does not grasp it, or there."""
    solid = OrientedBox.upright((1.6, -0.5, 0.3), (0.1, 0.1, 0.1))
    script = Script([(seen(0.0), seen(0.5)), (seen(0.0, sized=False),)], rest=(solid,))
    first, second = looked(sight_of(script), 2)[0]
    assert not first.hidden
    assert second.hidden == {"b1"}
    assert second.obstacles == (solid,)
    assert looked(sight_of(script, covered=True))[0][0].obstacles is None
    assert looked(sight_of(Script([(seen(0.0, sized=False),)])))[0][0].unsized == {"b1"}


def test_nothing_is_made_of_frames_that_something_is_wrong_with() -> None:
    """The reasons are those of the check."""
    script = Script([(seen(0.0),)], wrong=("camera front: black", "camera top: frozen"))
    sight = sight_of(script)
    with pytest.raises(DeviceError, match="camera front: black; camera top: frozen"):
        looked(sight)
    assert (script.asked, sight.last) == ([], None)


def test_perception_is_told_what_may_still_come_and_what_was_there() -> None:
    """By the note, less what has left; nothing is taken over when something is in doubt."""
    script = Script([(seen(0.0, "a"), seen(0.5))])
    sight, pile = sight_of(script), Pile()
    sight.bind(pile, lambda: False)
    (view,), _ = looked(sight)
    pile.see(view)
    named = next(box for box in view.boxes if isinstance(box, Recognition))
    pile.take(named.id, 3.0)
    looked(sight)
    sight.doubt()
    looked(sight)
    assert [[line.count for line in lines or ()] for lines in script.asked] == [[2], [1], [1]]
    assert [before if before is None else len(before.boxes) for before in script.before] == [
        None,
        1,
        None,
    ]


def test_a_box_that_the_reader_tells_goes_into_the_picture_book() -> None:
    """With the frames that showed it; nobody learns of a box that was never seen."""
    script = Script([(seen(0.0), seen(0.5))])
    sight, pile = sight_of(script), Pile()
    sight.bind(pile, lambda: False)
    pile.see(looked(sight)[0][0])
    pile.take(BoxId("b1"), 2.0)
    sight.learn(BoxId("b1"), NOTE[0].product)
    sight.learn(BoxId("nobody"), NOTE[0].product)
    assert script.learned == ["a"]
    assert "a" in sight.book


def test_a_box_that_a_person_denies_does_not_come_back() -> None:
    """Perception may go on to see it."""
    sight = sight_of(Script([(seen(0.0), seen(0.5))]))
    looked(sight)
    sight.deny(BoxId("b1"))
    assert [box.id for box in looked(sight)[0][0].boxes] == ["b2"]


def test_perception_is_told_what_is_no_box_and_relies_on_no_look_before() -> None:
    """Something else explains what is seen there: also where the picture has not changed."""
    script = Script([(seen(0.0), seen(0.5))])
    sight = sight_of(script)
    looked(sight)
    sight.deny(BoxId("b1"))
    looked(sight)
    looked(sight)
    no_box = Refuted((seen(0.5).shape,))
    assert script.refuted == [Refuted(), no_box, no_box]
    assert [before is None for before in script.before] == [True, True, False]
    seam = OrientedBox.upright((1.4, 0.0, 0.3), (0.002, 0.3, 0.2))
    sight.part(seam)
    looked(sight)
    assert script.refuted[-1] == Refuted((seen(0.5).shape,), (seam,))
    assert script.before[-1] is None


def test_a_detected_box_has_the_one_size_of_the_note_that_fits() -> None:
    """Turned as it stands; a size of no product stays as it was measured."""
    off = OrientedBox.upright((1.6, 0.0, 0.3), (0.31, 0.39, 0.26))
    odd = OrientedBox.upright((1.6, 0.0, 0.3), (0.2, 0.39, 0.26))
    for shape, size in ((off, SIZE), (odd, odd.size)):
        box = Remembered(BoxId("b1"), SeenBox(shape, 0.9, np.eye(6)))
        assert perceived(box, NOTE).shape.size == pytest.approx(size)
        assert perceived(box).shape == shape
    assert turned_like((0.4, 0.3, 0.25), (0.3, 0.4, 0.25)) == (0.3, 0.4, 0.25)
    assert turned_like((0.4, 0.3, 0.25), (0.5, 0.4, 0.25)) is None


@given(
    st.tuples(*[st.floats(0.1, 0.5)] * 3),
    st.permutations((0, 1)),
    st.integers(0, 1),
    st.floats(0.02, 0.24),
)
def test_of_a_box_of_which_a_strip_is_free_the_whole_edges_tell_how_it_lies(
    size: Vector3, lies: list[int], axis: int, hidden: float
) -> None:
    """However short the third one looks: turned by a quarter the case may fit that better."""
    true = (size[lies[0]], size[lies[1]], size[2])
    seen = [*true]
    seen[axis] -= hidden
    if seen[axis] > 0.02 and min(abs(seen[axis] - true[1 - axis]), np.ptp(true[:2])) > 0.001:
        assert turned_like(size, (seen[0], seen[1], seen[2]), 0.25) == true
