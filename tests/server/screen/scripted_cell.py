"""A cell that plays a run in a few seconds: what the browser test looks at."""

import itertools
import math
import threading
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO

from PIL import Image, ImageDraw

from depal.app.serve.outside import Records
from depal.cell.files import shipped_cell
from depal.domain import CellLayout, Request, cell_from_pallet
from depal.server.cell import Order, Refusal, Settings, Watcher
from depal.server.cellstate import (
    Alarm,
    CellState,
    Mode,
    QuestionState,
    QueueLine,
    RequestState,
    Solid,
    StandingBox,
    TaskNode,
    TaskTree,
    TrolleyState,
)

STEP = 0.1
"""Between two states [s of wall time]."""

PICK = ((-0.1, -0.9, 1.3, 0.0, -0.3, 0.0), (0.25, -0.7, 1.1, 0.0, -0.3, 0.0))
PLACE = ((-1.5, -0.9, 1.3, 0.0, -0.3, 0.0), (1.5, -0.9, 1.3, 0.0, -0.3, 0.0))
ROUND = ("Take it off the pallet", "Leave it")


class ScriptedCell:
    """See `depal.server.cell.Cell`; its run asks one question and wants one trolley exchanged."""

    def __init__(self, step: float = STEP, *, patient: bool = False) -> None:
        """A patient one waits after its first box for a request, so no visitor is too slow."""
        self._asked = threading.Event()
        if not patient:
            self._asked.set()
        self.records: Records | None = None
        self._layout = shipped_cell("default")
        self._step = step
        self._lock = threading.RLock()
        self._wake = threading.Event()
        self._watchers: list[Watcher] = []
        self._requests: dict[str, Request] = {}
        self._settings = Settings()
        self._order: Order | None = None
        self._answer: str | None = None
        self._closed: dict[str, str] = {}
        self._pictures: list[bytes] = [b""]
        self._state = CellState(
            reason="No delivery is started.",
            joints=self._layout.robot.parked,
            trolleys=tuple(
                TrolleyState(
                    s.id,
                    present=True,
                    boxes=0,
                    fill=0.0,
                    full=False,
                    exchanging=False,
                    aside=s.id == self._layout.aside,
                )
                for s in self._layout.storages
            ),
        )
        self._ended = threading.Event()

    @property
    def layout(self) -> CellLayout:
        """The cell."""
        return self._layout

    def state(self) -> CellState:
        """What was told last."""
        return self._state

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Calls a function with every new state."""
        self._watchers.append(watcher)
        return lambda: self._watchers.remove(watcher)

    def start(self, order: Order | None = None) -> None:
        """Begins, or goes on."""
        with self._lock:
            if self._state.mode in {Mode.STOPPED, Mode.HELD} and order is None:
                self._tell(mode=Mode.EXECUTE, reason="Boxes are being moved.", stopping=False)
                return
            if self._state.mode not in {Mode.IDLE, Mode.COMPLETE} or order is None:
                raise Refusal("the delivery on the pallet is not finished yet")
            self._order = order
            self._requests |= dict(order.requests)
        threading.Thread(target=self._run, args=(order,), daemon=True).start()

    def hold(self, source: str) -> None:
        """Nothing new begins."""
        del source
        with self._lock:
            if self._state.mode is not Mode.EXECUTE:
                raise Refusal(f"the cell is {self._state.mode.value} already")
            self._tell(mode=Mode.HELD, reason="Held by a person. Press Resume to go on.")

    def resume(self, source: str) -> None:
        """Goes on."""
        del source
        with self._lock:
            if self._state.mode is Mode.EXECUTE and not self._state.stopping:
                raise Refusal("the cell is working")
            self._tell(mode=Mode.EXECUTE, reason="Boxes are being moved.", stopping=False)

    def stop_after_box(self, source: str) -> None:
        """Finishes the box in hand."""
        del source
        self._tell(stopping=True)

    def add_request(self, key: str, request: Request) -> None:
        """One more."""
        with self._lock:
            self._requests[key] = request
            self._estimate()
        self._asked.set()

    def change_request(self, key: str, request: Request) -> None:
        """Another priority."""
        with self._lock:
            if key not in self._requests:
                raise Refusal(f"request {key} has been served already")
            self._requests[key] = request
            self._estimate()

    def cancel_request(self, key: str) -> None:
        """Not wanted any more."""
        with self._lock:
            if self._requests.pop(key, None) is None:
                raise Refusal(f"request {key} has been served already")
            self._estimate()

    def answer(self, question: str, choice: str, source: str) -> None:
        """The first answer counts."""
        with self._lock:
            asked = next((q for q in self._state.questions if q.id == question), None)
            if asked is None:
                told = self._closed.get(question, f"there is no open question {question!r}")
                raise Refusal(told)
            self._closed[question] = f"{source} has answered this question: {choice}"
            self._answer = choice
            if self.records is not None:
                self.records.answered(question, choice, source, self._state.at)
            self._tell(questions=(), alarms=())
            self._wake.set()

    def set(self, settings: Settings) -> None:
        """Other settings."""
        self._settings = settings
        self._tell(w=settings.w, speed=settings.speed, policy=settings.policy)

    def why(self, box: str) -> str:
        """What the last selection said."""
        return next(line.reason for line in self._state.queue if line.box == box)

    def picture(self) -> bytes:
        """The pile as a camera might see it."""
        return self._pictures[-1]

    # The run

    def _tell(self, **changes: object) -> None:
        with self._lock:
            version = self._state.version + 1
            at = changes.pop("at", self._state.at)
            self._state = replace(self._state, version=version, at=at, **changes)
            for watcher in tuple(self._watchers):
                watcher(self._state)

    def _run(self, order: Order) -> None:
        pose = cell_from_pallet(order.delivery.pallet_size)
        names = {g: p.name for g, p in order.delivery.products.items()}
        queue = []
        for number, case in enumerate(order.delivery.stack or (), start=1):
            middle = tuple(c + e / 2 for c, e in zip(case.corner, case.size, strict=True))
            dx, dy, dz = case.size
            solid = Solid(pose.apply(middle), (dy, dx, dz), 0.0)
            h = solid.centre[2] - 0.3 * solid.centre[0]
            queue.append(
                QueueLine(f"b{number}", case.gtin, names[case.gtin], solid, h, 0.0, h, "blocked",
                          "")
            )  # fmt: skip
        self._tell(
            mode=Mode.EXECUTE, reason="Boxes are being moved.", delivery=order.delivery.id,
            run=order.run, boxes=len(queue), stored=0, aside=0, queue=tuple(queue), standing=(),
        )  # fmt: skip
        self._sort()
        for turn in itertools.count():
            if not self._state.queue:
                break
            self._sort()
            self._look()
            self._move(turn)
            if turn == 0:
                self._asked.wait()
                self._sort()
                self._ask("take/b7", "The arm cannot take box b7: no reachable grasp. "
                          "Please take it off the pallet.", ("taken", "it is not there"),
                          Mode.HELD)  # fmt: skip
            if turn == 1:
                self._exchange("trolley_2")
        if self.records is not None:
            result: dict[str, object] = {"stored": self._state.stored, "boxes": self._state.boxes}
            self.records.run_ended(order.run, "done", self._state.at, result)
        self._tell(mode=Mode.COMPLETE, reason="The pallet is empty.", target=None, trees=())

    def _sort(self) -> None:
        """The best first; requests pull theirs and what lies on it."""
        lines = list(self._state.queue)
        pulls = self._pulls(lines)
        scored = []
        for line in lines:
            l = pulls.get(line.box, 0.0)  # noqa: E741
            s = 0.5 * line.h + 0.5 * l
            on_top = tuple(o.box for o in lines if _on(o.solid, line.solid))
            reason = f"{', '.join(on_top)} on top" if on_top else "scored lower"
            scored.append(replace(line, l=l, s=s, blockers=on_top, reason=reason,
                                  requested=line.box in self._aims))  # fmt: skip
        free = [line for line in scored if not line.blockers]
        target = max(free, key=lambda line: line.s) if free else None
        best = sorted(scored, key=lambda line: -line.s)
        told = tuple(
            replace(line, fate="chosen", reason="the best score of all boxes that can be grasped")
            if target is not None and line.box == target.box
            else line
            for line in best
        )
        name = target.box if target is not None else None
        self._tell(
            queue=told, target=name, explanation="the best score of all boxes that can be grasped"
        )
        self._estimate()

    def _pulls(self, lines: list[QueueLine]) -> dict[str, float]:
        self._aims: dict[str, str] = {}
        pulls: dict[str, float] = {}
        for key, request in self._requests.items():
            wanted = [li for li in lines if li.gtin == request.gtin or li.box == request.box]
            if not wanted:
                continue
            aim = max(wanted, key=lambda line: line.h)
            self._aims[aim.box] = key
            ahead = [aim]
            while ahead:
                line = ahead.pop()
                pulls[line.box] = max(pulls.get(line.box, 0.0), 4 * request.priority)
                ahead += [o for o in lines if _on(o.solid, line.solid)]
        return pulls

    def _estimate(self) -> None:
        aims = {key: box for box, key in getattr(self, "_aims", {}).items()}
        states = []
        order = [line.box for line in self._state.queue if not line.blockers]
        for key, r in self._requests.items():
            box = aims.get(key)
            before = None
            if box is not None:
                line = next((li for li in self._state.queue if li.box == box), None)
                before = len(line.blockers) if line is not None else 0
                if line is not None and not line.blockers:
                    before = order.index(box)
            states.append(
                RequestState(key, r.gtin, r.box, r.priority, r.arrived, r.due, box, before,
                             None if before is None else (before + 1) * 8 / 60)
            )  # fmt: skip
        self._tell(requests=tuple(states))

    def _look(self) -> None:
        image = Image.new("RGB", (540, 720), "#5c6166")
        draw = ImageDraw.Draw(image)
        for line in sorted(self._state.queue, key=lambda line: -line.solid.centre[0]):
            y, z = line.solid.centre[1], line.solid.centre[2]
            _, w, h = line.solid.size
            x0, y0 = 270 - (y + w / 2) * 350, 640 - (z + h / 2) * 350
            x1, y1 = 270 - (y - w / 2) * 350, 640 - (z - h / 2) * 350
            edge = "#d55e00" if line.box == self._state.target else "#0072b2"
            draw.rectangle((x0, y0, x1, y1), fill="#b59a6f", outline=edge, width=3)
            draw.text(((x0 + x1) / 2, (y0 + y1) / 2), line.box, fill="white", anchor="mm")
        out = BytesIO()
        image.save(out, "JPEG")
        self._pictures.append(out.getvalue())
        self._tell(picture=len(self._pictures) - 1)

    def _move(self, turn: int) -> None:
        state = self._state
        line = next(line for line in state.queue if line.box == state.target)
        side = turn % 2
        self._tell(trees=_trees(line.box, 0))
        self._travel(self._layout.robot.parked, PICK[side])
        self._tell(held=line.box, trees=_trees(line.box, 1))
        left = tuple(each for each in self._state.queue if each.box != line.box)
        self._tell(queue=left)
        self._travel(PICK[side], PLACE[side])
        trolley = f"trolley_{1 + turn % 2 * 3 + turn // 2 % 3}"
        with self._lock:
            key = self._aims.get(line.box)
            if key is not None:
                self._requests.pop(key, None)
                if self.records is not None:
                    self.records.request_ended(key, served=True, at=self._state.at, reason="")
        self._tell(
            held=None,
            stored=self._state.stored + 1,
            rate=420.0,
            standing=(*self._state.standing, self._standing(line, trolley)),
            trolleys=tuple(
                replace(t, boxes=t.boxes + 1, fill=min(t.fill + 0.14, 1)) if t.id == trolley else t
                for t in self._state.trolleys
            ),
            trees=_trees(line.box, 2),
        )
        self._estimate()
        if self._state.stopping:
            self._tell(mode=Mode.STOPPED, reason="Stopped after a box. Press Start to go on.")
        self._travel(PLACE[side], self._layout.robot.parked)

    def _standing(self, line: QueueLine, trolley: str) -> StandingBox:
        storage = self._layout.storage(trolley)
        place = storage.places[len(self._state.standing) % len(storage.places)]
        x, y, z = line.solid.size
        centre = place.cell_from_place.apply((0.3, 0.0, z / 2))
        yaw = math.atan2(*reversed([row[0] for row in place.cell_from_place.rotation[:2]]))
        return StandingBox(line.box, line.gtin, place.id, Solid(centre, (x, y, z), yaw))

    def _travel(self, one: tuple[float, ...], other: tuple[float, ...]) -> None:
        for part in range(1, 6):
            while self._state.mode is not Mode.EXECUTE:
                self._pause()
            share = part / 5
            joints = tuple(a + (b - a) * share for a, b in zip(one, other, strict=True))
            self._tell(joints=joints, at=self._state.at + 4 * self._step)
            self._pause()

    def _pause(self) -> None:
        self._ended.wait(self._step)

    def _ask(self, name: str, text: str, choices: tuple[str, ...], mode: Mode) -> None:
        self._answer = None
        self._wake.clear()
        question = QuestionState(
            f"{self._state.run}/{name}", text, choices, name.split("/")[1], self._state.at
        )
        if self.records is not None and self._state.run is not None:
            self.records.asked(self._state.run, question)
        alarm = Alarm(question.id, text, "Answer the question.", self._state.at)
        self._tell(mode=mode, reason=text, questions=(question,), alarms=(alarm,))
        self._wake.wait()
        self._tell(mode=Mode.EXECUTE, reason="Boxes are being moved.")

    def _exchange(self, trolley: str) -> None:
        def with_trolley(**changes: object) -> tuple[TrolleyState, ...]:
            return tuple(
                replace(t, **changes) if t.id == trolley else t for t in self._state.trolleys
            )

        self._tell(trolleys=with_trolley(full=True, exchanging=True, fill=0.83))
        self._ask(f"exchange/{trolley}", f"{trolley} is full. Please pull it out and put an "
                  "empty one into its bay.", ("done",), Mode.SUSPENDED)  # fmt: skip
        empty = with_trolley(full=False, exchanging=False, fill=0.0, boxes=0)
        storage = f"{trolley}/"
        left = tuple(b for b in self._state.standing if not b.place.startswith(storage))
        self._tell(trolleys=empty, standing=left)


def _on(upper: Solid, lower: Solid) -> bool:
    """Whether a box stands on another."""
    if abs(upper.centre[2] - upper.size[2] / 2 - lower.centre[2] - lower.size[2] / 2) > 0.01:
        return False
    return all(
        abs(upper.centre[k] - lower.centre[k]) < (upper.size[k] + lower.size[k]) / 2 - 0.005
        for k in (0, 1)
    )


def _trees(box: str, phase: int) -> tuple[TaskTree, ...]:
    def state(at: int) -> str:
        """What was told last."""
        return "accomplished" if phase > at else "running" if phase == at else "disabled"

    nodes = (
        TaskNode(f"store({box})", 0, "enabled" if phase < 2 else "accomplished", concrete=False),
        TaskNode(f"take({box})", 1, state(0), concrete=True),
        TaskNode(
            f"leave({box})", 1, state(1), concrete=True, why="waits for take" if phase == 0 else ""
        ),
    )
    return (TaskTree(1, 0.8, nodes),)
