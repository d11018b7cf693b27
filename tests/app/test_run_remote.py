"""The ordinary controller over a world in a process of its own, faster than real time."""

import asyncio
from pathlib import Path

import pytest
from tiny_runs import THREE, run, tiny

from depal.app.run.accounting import TAKEN_FACT
from depal.app.run.assembly import Assembly, Wiring, assemble
from depal.cell.departures import Fate
from depal.cell.files import shipped_cell
from depal.cell.tasks import read_shipped_tasks
from depal.cell.workplace import Ports, Settings
from depal.domain import BoxId
from depal.drivers.remote import RemoteWorld, connect, start_world
from depal.executive import events as ev
from depal.executive.clock import LoopClock, run_paced
from depal.executive.journal import MemoryJournal
from depal.logistics.store import LocalStore, by_storage
from depal.ports import Question
from depal.ports.wire.messages import Truth

LAYOUT, DELIVERY = shipped_cell("default"), tiny(*THREE)


class Onlooker:
    """Answers what is so, and does it."""

    def __init__(self, world: RemoteWorld) -> None:
        """Beside this world."""
        self._world = world

    async def ask(self, question: Question) -> str:
        """At once."""
        answer = await self._world.deeds.what_is_so(question)
        await self._world.deeds.do(question, answer)
        return answer

    def heard(self, _: int, events: tuple[ev.Event, ...]) -> None:
        """Tells the referee which box a name means."""
        for event in events:
            for key, value in event.facts if isinstance(event, ev.Ended) else ():
                if key.endswith(TAKEN_FACT) and value:
                    self._world.witness_lifted(BoxId(key.removesuffix(TAKEN_FACT)))


async def emptied(world: RemoteWorld) -> tuple[Assembly, Truth]:
    """The pallet, with a sight that knows the truth."""
    await world.build(LAYOUT, DELIVERY, seed=0, severity="normal", number=1)
    onlooker = Onlooker(world)
    with LocalStore() as store:
        places = by_storage(LAYOUT.places, without=LAYOUT.aside)
        store.seed_places([DELIVERY], places, seed=0)
        ports = Ports(
            arm=world.arm,
            gripper=world.gripper,
            reader=world.reader,
            bays=world.bays,
            safety=world.safety,
            person=onlooker,
            store=store,
            sight=world.truth_sight,
            clock=LoopClock(),
            override=world.override,
        )
        journal = MemoryJournal()
        wired = assemble(Wiring(LAYOUT, DELIVERY, Settings(), read_shipped_tasks(), journal), ports)
        wired.notes.listen(heard=onlooker.heard)
        await wired.controller.empty_pallet(())
    return wired, await world.referee.judge()


@pytest.mark.slow
def test_a_pallet_is_emptied_through_the_wire_and_the_referee_agrees(tmp_path: Path) -> None:
    """Each box stands where the cell believes it to stand; none was pressed on anything."""

    async def work() -> tuple[Assembly, Truth]:
        world = await connect(tmp_path, len(LAYOUT.cameras))
        try:
            return await asyncio.wait_for(emptied(world), 2000.0)
        finally:
            await world.shutdown()

    run(THREE)  # here: what is compiled or loaded at first use would take the cell's time
    card = start_world(tmp_path, 20.0)
    wired, truth = run_paced(work(), card.pace)
    departures = wired.work.departures.sequence
    assert [(d.fate, d.reason) for d in departures] == [(Fate.STORED, "")] * len(THREE)
    for departure in departures:
        assert truth.where[truth.names[departure.box]] == departure.place
    assert truth.collisions == ()
    assert truth.lost == 0
    assert not (tmp_path / "world.json").exists()
