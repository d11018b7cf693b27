"""A world for the executive: primitives that do what their schemata promise, or do not."""

import asyncio
import random
from collections.abc import Callable, Mapping
from importlib.resources import files

from depal.executive.clock import LoopClock
from depal.executive.conditions import Key, Value
from depal.executive.engine import Call, Engine, Report
from depal.executive.events import Change, Outcome
from depal.executive.journal import Journal, MemoryJournal
from depal.executive.language import parse
from depal.executive.runtime import Context, Primitive, Runtime
from depal.executive.schema import Action, Repository

STORE = parse((files("depal.cell.tasks") / "store.task").read_text(encoding="utf-8"), "store.task")
"""The paper's running example, as it ships."""


def effect(action: str, box: str, facts: Mapping[Key, Value]) -> tuple[Change, ...]:
    """What an action of the store task changes when all goes well."""
    return {
        "kr60_reach": (("kr60.at", box),),
        "kr60_grasp": ((f"{box}.taken", True),),
        "kr60_show": (("kr60.at", "reader"),),
        "read_barcode": ((f"{box}.known", True),),
        "ask_target": ((f"{box}.target", "trolley_1"),),
        "kr60_carry": (("kr60.at", facts.get(f"{box}.target")),),
        "kr60_release": ((f"{box}.taken", False), (f"{box}.stored", True), ("kr60.at", None)),
    }[action]


class World:
    """Runs primitives in simulated time, counts motions, and fails as it is told.

    Attributes:
        done: every motion that has really been made: its attempt, action and box.
        truth: the facts as the world has them, whatever the executive believes.
    """

    def __init__(self, repository: Repository = STORE, fail: float = 0.0, seed: int = 0) -> None:
        """Fails a share `fail` of the primitives, drawn with `seed`."""
        self.repository = repository
        self.random = random.Random(seed)  # noqa: S311 - a simulation
        self.fail = fail
        self.done: list[tuple[int, str, str]] = []
        self.truth: dict[Key, Value] = {}
        self.overrides: dict[str, Primitive] = {}

    def primitives(self) -> dict[str, Primitive]:
        """One for each action."""
        return {
            name: self._primitive(name)
            for name, schema in self.repository.schemata.items()
            if isinstance(schema, Action)
        }

    def probes(self) -> dict[str, Primitive]:
        """What the arm's and the gripper's sensors tell: the truth about what an action sets."""
        return dict.fromkeys(("arm", "gripper"), self._look)

    def _primitive(self, name: str) -> Primitive:
        async def run(context: Context) -> Report:
            if name in self.overrides:
                return await self.overrides[name](context)
            await asyncio.sleep(1.0 + self.random.random())
            box = context.args["Box"]
            if self.random.random() < self.fail:
                return Report(outcome=Outcome.FAILED, reason="it slipped")
            changes = effect(name, box, context.facts)
            self.truth.update(changes)
            if not context.action.idempotent:
                self.done.append((context.attempt, name, box))
            return Report(changes)

        return run

    async def _look(self, context: Context) -> Report:
        box = context.args["Box"]
        names = [f"{box}.{fact.attribute}" for fact in context.action.sets]
        names = [n if not n.endswith(".at") else "kr60.at" for n in names]
        return Report(tuple((name, self.truth.get(name)) for name in names if name in self.truth))


def runtime_of(
    world: World, journal: Journal | None = None, engine: Engine | None = None
) -> Runtime:
    """A runtime on the running loop's time."""
    return Runtime(
        engine or Engine(world.repository),
        journal if journal is not None else MemoryJournal(),
        LoopClock(),
        world.primitives(),
        world.probes(),
    )


async def until(runtime: Runtime, reached: Callable[[], bool]) -> None:
    """Waits for something, woken by events only."""
    happened = asyncio.Event()
    runtime.listen(lambda _, __: happened.set())
    while not reached():
        happened.clear()
        await happened.wait()


async def store_all(runtime: Runtime, boxes: list[str]) -> None:
    """Allocates a store for each box and waits until all trees have ended."""
    runtime.allocate(*(Call("store", (box,)) for box in boxes))
    await until(runtime, lambda: not runtime.engine.state.trees)
