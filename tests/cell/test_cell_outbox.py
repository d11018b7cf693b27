"""What the store is to be told reaches it in order and counts once; dead modules are found out."""

import asyncio
from dataclasses import dataclass, field

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.modules import Modules
from depal.cell.outbox import DEADLINE, Outbox
from depal.domain import BoxId, Gtin, PlaceId
from depal.errors import DeviceError
from depal.executive.clock import run_simulated
from depal.ports import Movement

NO_VACUUM, VACUUM = 0.0, 40_000.0


@dataclass(slots=True)
class MoodyStore:
    """A store that refuses, or answers too late, by a script; then it answers."""

    script: list[str]
    told: list[str] = field(default_factory=list)

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Knows nothing."""
        del gtin
        return ()

    async def moved(self, movement: Movement) -> None:
        """Takes note, refuses, or is late."""
        mood = self.script.pop(0) if self.script else "well"
        if mood == "silent":
            raise DeviceError("no answer")
        if mood == "late":
            await asyncio.sleep(2 * DEADLINE)
        self.told.append(movement.id)


def movement(number: int) -> Movement:
    """A movement by its number."""
    return Movement(f"m{number}", BoxId(f"b{number}"), None, PlaceId("shelf/level_1"), 0.0)


@given(script=st.lists(st.sampled_from(["well", "silent", "late"]), max_size=8))
def test_every_movement_is_told_in_order_whatever_the_store_does(script: list[str]) -> None:
    """And nobody waits longer than the deadline for the first try."""

    async def work() -> tuple[list[str], int]:
        store = MoodyStore(list(script))
        outbox = Outbox(store)
        loop = asyncio.get_running_loop()
        for number in range(3):
            before = loop.time()
            await outbox.tell(movement(number))
            assert loop.time() - before <= DEADLINE + 1e-6
        assert await outbox.emptied(10_000.0)
        return store.told, len(outbox)

    assert run_simulated(work()) == (["m0", "m1", "m2"], 0)


def test_a_store_that_never_answers_does_not_hold_the_end_for_ever() -> None:
    """What it was not told still waits."""

    async def work() -> tuple[bool, int]:
        outbox = Outbox(MoodyStore(["silent"] * 1000))
        await outbox.tell(movement(0))
        return await outbox.emptied(100.0), len(outbox)

    assert run_simulated(work()) == (False, 1)


def test_a_module_that_is_silent_where_another_seals_is_dead() -> None:
    """The box is there, so nothing but the module can be wrong."""
    modules = Modules()
    modules.tried(BoxId("b1"), ["lower"], {"front": NO_VACUUM, "lower": NO_VACUUM})
    assert modules.dead == frozenset()
    assert modules.suspects(BoxId("b1"), 2) == {"lower"}
    assert modules.suspects(BoxId("b1"), 1) == modules.suspects(BoxId("b2"), 2) == frozenset()
    modules.tried(BoxId("b1"), ["front"], {"front": VACUUM, "lower": NO_VACUUM})
    assert modules.dead == {"lower"}


def test_a_module_that_is_silent_at_two_boxes_in_a_row_is_dead_until_it_seals() -> None:
    """One box may not be where it looks, two are."""
    modules = Modules()
    for name in ("b1", "b1", "b2"):
        modules.tried(BoxId(name), ["lower"], {"lower": NO_VACUUM})
    assert modules.dead == {"lower"}
    modules.tried(BoxId("b3"), ["lower"], {"lower": VACUUM})
    assert modules.dead == frozenset()
