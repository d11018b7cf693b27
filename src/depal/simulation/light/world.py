"""Where every box of a light world is, and what the arm does to them."""

from collections.abc import Callable
from dataclasses import dataclass, field

from depal.domain import CellLayout, Gtin, Place, PlaceId
from depal.geometry import OrientedBox, Pose, Vector3
from depal.ports import Trajectory
from depal.simulation.cases import Case

PALLET, HAND, FLOOR, REMOVED = "pallet", "hand", "floor", "removed"

GIVE = 0.004
"""Over so much of its way up a box comes to hang on the arm with all of its weight [m]."""

NEAR = 0.02
"""The cups seal on a top whose middle is this near to theirs [m]."""

BESIDE = 0.035
"""Boxes with less between them may stick together [m]."""

SHORT = 0.06
"""From so high a box that is let go comes to stand below [m]; from higher it is lost."""

VACUUM, LEAKING = 30_000.0, 7_500.0
"""What a module's sensor reads on a box that is held, and on one that is not sealed [Pa]."""

AXES = 6


@dataclass(slots=True)
class LightBox:
    """A box as it is.

    Attributes:
        index: in the delivery's stack.
        gtin: its product.
        mass: [kg].
        shape: where it is, in the cell frame.
        where: "pallet", "hand", "floor", "removed", or the place that it stands in.
        placed: the places that it was put into, in order.
    """

    index: int
    gtin: Gtin
    mass: float
    shape: OrientedBox
    where: str = PALLET
    placed: list[PlaceId] = field(default_factory=list)
    low: Vector3 = (0.0, 0.0, 0.0)
    high: Vector3 = (0.0, 0.0, 0.0)

    def put(self, shape: OrientedBox) -> None:
        """It is there now; boxes are square to the cell."""
        self.shape = shape
        x, y, z = shape.pose.translation
        a, b, c = (
            sum(abs(turn) * edge for turn, edge in zip(row, shape.size, strict=True)) / 2
            for row in shape.pose.rotation
        )
        self.low, self.high = (x - a, y - b, z - c), (x + a, y + b, z + c)

    @property
    def top(self) -> Vector3:
        """The middle of its upper face [m]."""
        x, y, _ = self.shape.pose.translation
        return (x, y, self.high[2])


@dataclass(slots=True)
class Course:
    """A motion that goes on.

    Attributes:
        times: of its corners [s], from its start.
        corners: x, y, z, yaw at each.
        began: when [s].
        drops: when the box in the hand falls [s]; None where it does not.
    """

    times: list[float]
    corners: list[list[float]]
    began: float
    drops: float | None = None

    def at(self, now: float) -> list[float]:
        """The axes at a time, held beyond the ends."""
        since = now - self.began
        times, corners = self.times, self.corners
        if since >= times[-1]:
            return corners[-1]
        for k in range(len(times) - 1):
            if since < times[k + 1]:
                share = max(since - times[k], 0.0) / (times[k + 1] - times[k])
                return [
                    a + share * (b - a) for a, b in zip(corners[k], corners[k + 1], strict=True)
                ]
        return corners[-1]


class LightWorld:
    """The truth. Time passes by `advance`, whoever asks; the world needs no controller.

    Attributes:
        layout: the cell.
        boxes: by their index in the stack.
        held: the boxes that the cups hold, each as `flange_from_box` at its shift [m].
        vacuum: of the lower module [Pa].
        bays: the trolley in each bay, None where there is none.
        motions: how many the arm has begun.
        changed: when something last changed [s].
    """

    def __init__(self, layout: CellLayout, cases: tuple[Case, ...]) -> None:
        """The stack stands, the arm is parked over the floor, all trolleys are in."""
        self.layout = layout
        self.boxes = [LightBox(c.index, c.gtin, c.mass, c.shape) for c in cases]
        for box in self.boxes:
            box.put(box.shape)
        self.axes: list[float] = [0.6, 0.0, 1.6, 0.0, 0.0, 0.0]
        self.held: dict[int, Vector3] = {}
        self.vacuum = 0.0
        self.bays: dict[str, str | None] = {each.id: each.id for each in layout.storages}
        self.motions = 0
        self.changed = 0.0
        self.folded = False
        self._listeners: list[Callable[[], None]] = []
        self._course: Course | None = None
        self._deck = layout.pallet.cell_from_pallet.translation[2]
        self._places = [_Space.of(place) for place in layout.places.values()]
        self._pallet = _pallet_of(layout)

    def listen(self, changed: Callable[[], None]) -> None:
        """Calls a function after every change of where a box is."""
        self._listeners.append(changed)

    def _tell(self, now: float) -> None:
        self.changed = now
        for listener in self._listeners:
            listener()

    # The arm

    def begin(self, trajectory: Trajectory, now: float, drops: float | None) -> Course:
        """The arm sets out.

        Args:
            trajectory: of its axes.
            now: the time [s].
            drops: when a box in the hand falls [s].
        """
        self.motions += 1
        times, corners = trajectory.times.tolist(), trajectory.positions.tolist()
        self._course = course = Course(times, corners, now, drops)
        return course

    def is_on(self, course: Course) -> bool:
        """Whether the arm still follows a course."""
        return self._course is course

    def advance(self, now: float) -> None:
        """Lets the time pass."""
        course = self._course
        if course is None:
            return
        if course.drops is not None and now >= course.drops:
            self._move(course.at(course.drops))
            course.drops = None
            self.vacuum = 0.0
            self._let_go(now)
        self._move(course.at(now))
        if now - course.began >= course.times[-1]:
            self._course = None

    def stop(self, now: float) -> None:
        """The arm stands where it is."""
        self.advance(now)
        self._course = None

    def _move(self, axes: list[float]) -> None:
        """The flange is there now, and what hangs on it; yaw turns the boxes with it."""
        if not self.held:
            self.axes = axes
            return
        turn = axes[3] - self.axes[3]
        self.axes = axes
        for index, before in self.held.items():
            box, shift = self.boxes[index], before
            pose = Pose.from_yaw((0.0, 0.0, 0.0), turn) @ box.shape.pose if turn else box.shape.pose
            x, y, z = Pose.from_yaw((0.0, 0.0, 0.0), turn).apply(shift) if turn else shift
            self.held[index] = (x, y, z)
            at = (axes[0] + x, axes[1] + y, axes[2] + z)
            box.put(OrientedBox(Pose(at, pose.rotation), box.shape.size))

    def load(self, now: float) -> float:
        """What hangs on the flange [kg]."""
        self.advance(now)
        return sum(self._hanging(index) * self.boxes[index].mass for index in self.held)

    def _hanging(self, index: int) -> float:
        """The share of a held box's weight that the arm carries."""
        box = self.boxes[index]
        off = box.low[2] - self._support(box)[0]
        return min(max(off / GIVE, 0.0), 1.0)

    def stands_over(self, index: int) -> str:
        """Where a held box would stand if it were let go."""
        return self._support(self.boxes[index])[1]

    def hangs(self, index: int) -> bool:
        """Whether a held box is off what it stood on."""
        return self._hanging(index) > 0.0

    # The cups

    def under_cups(self, now: float) -> int | None:
        """The box on whose top the cups are; None where there is none."""
        self.advance(now)
        x, y, z = self.axes[:3]
        for box in self.boxes:
            if box.where in {HAND, REMOVED}:
                continue
            a, b, c = box.top
            if abs(a - x) < NEAR and abs(b - y) < NEAR and abs(c - z) < NEAR:
                return box.index
        return None

    def neighbour(self, index: int) -> int | None:
        """A box on the pallet, with none upon it, that stands so near that it may stick."""
        box = self.boxes[index]
        for other in self.boxes:
            if other.index == index or other.where != PALLET or other.top[2] < box.low[2]:
                continue
            gap = max(max(other.low[k] - box.high[k], box.low[k] - other.high[k]) for k in range(2))
            if gap < BESIDE and other.low[2] < box.high[2] and not self.laden(other.index):
                return other.index
        return None

    def laden(self, index: int) -> bool:
        """Whether a box stands on a box."""
        box = self.boxes[index]
        return any(
            abs(other.low[2] - box.high[2]) < GIVE and _over(other, box)
            for other in self.boxes
            if other.index != index and other.where == box.where
        )

    def grip(self, indices: tuple[int, ...], now: float) -> None:
        """The cups hold these."""
        for index in indices:
            box = self.boxes[index]
            box.where = HAND
            x, y, z = box.shape.pose.translation
            self.held[index] = (x - self.axes[0], y - self.axes[1], z - self.axes[2])
        self.vacuum = VACUUM
        self._tell(now)

    def vent(self, now: float) -> None:
        """The valves close: what is held is let go."""
        self.advance(now)
        self.vacuum = 0.0
        self._let_go(now)

    def _let_go(self, now: float) -> None:
        if not self.held:
            return
        fallen, self.held = dict(self.held), {}
        for index in fallen:
            box = self.boxes[index]
            height, where = self._support(box)
            if where == FLOOR or box.low[2] - height > SHORT:
                box.where = FLOOR
                continue
            x, y, z = box.shape.pose.translation
            at = (x, y, z + height - box.low[2])
            box.put(OrientedBox(Pose(at, box.shape.pose.rotation), box.shape.size))
            box.where = where
            if where != PALLET:
                box.placed.append(PlaceId(where))
        self._tell(now)

    # People

    def take_away(self, index: int, now: float) -> None:
        """A person has taken a box out of the cell."""
        self.advance(now)
        self.held.pop(index, None)
        self.boxes[index].where = REMOVED
        self._tell(now)

    def empty_hand(self, now: float) -> None:
        """A person has taken all that hangs on the arm out of the cell."""
        self.advance(now)
        for index in self.held:
            self.boxes[index].where = REMOVED
        self.held = {}
        self._tell(now)

    def take_trolley(self, bay: str, now: float) -> None:
        """A trolley is pulled out of its bay, with what stands on it."""
        for box in self.boxes:
            if box.where.startswith(f"{bay}/"):
                box.where = REMOVED
        self.bays[bay] = None
        self._tell(now)

    # What stands on what

    def _support(self, box: LightBox) -> tuple[float, str]:
        """The height of what is under a box [m], and where it would stand; the floor else."""
        x, y, _ = box.shape.pose.translation
        space = next((s for s in self._places if s.contains(x, y, box.low[2], box.high[2])), None)
        if space is not None and self.bays[space.storage] is not None:
            floor, where = space.floor, str(space.name)
        elif self._over_pallet(x, y):
            floor, where = self._deck, PALLET
        else:
            return 0.0, FLOOR
        tops = [
            other.high[2]
            for other in self.boxes
            if other.where == where
            and other.index != box.index
            and other.high[2] < box.low[2] + SHORT
            and _over(other, box)
        ]
        return max([floor, *tops]), where

    def _over_pallet(self, x: float, y: float) -> bool:
        (a, b), (c, d) = self._pallet
        return a < x < c and b < y < d


@dataclass(frozen=True, slots=True)
class _Space:
    """A place, as far as it matters what is in it; places are square to the cell."""

    name: PlaceId
    storage: str
    low: Vector3
    high: Vector3

    @classmethod
    def of(cls, place: Place) -> "_Space":
        width, height = place.opening
        ends = [
            place.cell_from_place.apply(point)
            for point in ((0.0, -width / 2, 0.0), (place.depth, width / 2, height))
        ]
        low, high = (tuple(kind(*pair) for pair in zip(*ends, strict=True)) for kind in (min, max))
        storage = place.id.split("/", maxsplit=1)[0]
        return cls(place.id, storage, (low[0], low[1], low[2]), (high[0], high[1], high[2]))

    @property
    def floor(self) -> float:
        return self.low[2]

    def contains(self, x: float, y: float, bottom: float, top: float) -> bool:
        """Whether a box with its middle there is in it, or just above its opening."""
        (a, b, c), (d, e, f) = self.low, self.high
        return a < x < d and b < y < e and c - GIVE < bottom and top < f + SHORT


def _pallet_of(layout: CellLayout) -> tuple[tuple[float, float], tuple[float, float]]:
    stand = layout.pallet
    length, width, _ = stand.size
    ends = [
        stand.cell_from_pallet.apply(corner) for corner in ((0.0, 0.0, 0.0), (length, width, 0.0))
    ]
    (a, b, _), (c, d, _) = ends
    return (min(a, c), min(b, d)), (max(a, c), max(b, d))


def _over(one: LightBox, other: LightBox) -> bool:
    """Whether two boxes overlap on the ground by more than a seam."""
    return all(
        min(one.high[k], other.high[k]) - max(one.low[k], other.low[k]) > GIVE for k in range(2)
    )
