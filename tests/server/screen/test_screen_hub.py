"""Every viewer gets the newest state, at most so often, and is let go of when it is gone."""

import asyncio
from dataclasses import replace

import pytest

from depal.cell.files import shipped_cell
from depal.server.cellstate import CellState, Mode
from depal.server.fakes import FakeCell
from depal.server.screen.hub import LEAST, Hub


class Naps:
    """Sleep that ends when the test says so."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.asked: list[float] = []
        self.over = asyncio.Event()

    async def __call__(self, seconds: float) -> None:
        """Waits for the test."""
        self.asked.append(seconds)
        await self.over.wait()


async def settled() -> None:
    """Everything that can run now has run."""
    for _ in range(5):
        await asyncio.sleep(0)


def news(cell: FakeCell, run: int) -> None:
    """The cell tells of another run."""
    cell.tell(replace(cell.told, run=run))


def test_a_viewer_sees_the_present_and_then_only_the_newest() -> None:
    """A viewer sees the present and then only the newest."""

    async def scenario() -> list[int | None]:
        cell, naps, shown = FakeCell(shipped_cell("default")), Naps(), []

        async def show(state: CellState) -> None:
            shown.append(state.run)

        hub = Hub(cell, naps)
        viewer = hub.add(show, pause=0.1)
        task = asyncio.create_task(viewer.run())
        await settled()
        for run in range(1, 6):
            news(cell, run)
        await settled()
        assert shown == [None], "nothing follows another state at once"
        naps.over.set()
        await settled()
        task.cancel()
        assert naps.asked[0] == LEAST
        assert sum(naps.asked[:2]) == pytest.approx(0.1)
        return shown

    assert asyncio.run(scenario()) == [None, 5]


def test_the_cell_is_watched_once_and_not_when_nobody_looks() -> None:
    """The cell is watched once and not when nobody looks."""

    class Watched(FakeCell):
        watching = 0

        def watch(self, watcher):  # type: ignore[no-untyped-def] # noqa: ANN001, ANN202
            """Calls a function with every new state."""
            self.watching += 1
            end = super().watch(watcher)

            def over() -> None:
                self.watching -= 1
                end()

            return over

    async def scenario() -> None:
        cell = Watched(shipped_cell("default"))

        async def show(state: CellState) -> None:
            del state

        hub = Hub(cell)
        viewers = [hub.add(show) for _ in range(3)]
        assert (cell.watching, hub.viewers) == (1, 3)
        for viewer in viewers:
            hub.remove(viewer)
        assert (cell.watching, hub.viewers) == (0, 0)
        hub.add(show)
        assert cell.watching == 1

    asyncio.run(scenario())


def test_news_from_the_cells_thread_arrive_on_the_viewers_loop() -> None:
    """News from the cells thread arrive on the viewers loop."""

    async def scenario() -> tuple[int | None, bool]:
        cell, seen = FakeCell(shipped_cell("default")), asyncio.Queue[tuple[int | None, bool]]()
        loop = asyncio.get_running_loop()

        async def show(state: CellState) -> None:
            seen.put_nowait((state.run, asyncio.get_running_loop() is loop))

        hub = Hub(cell, lambda _: asyncio.sleep(0))
        task = asyncio.create_task(hub.add(show).run())
        await seen.get()
        await asyncio.to_thread(news, cell, 7)
        found = await seen.get()
        task.cancel()
        return found

    assert asyncio.run(scenario()) == (7, True)


def test_news_after_the_loop_has_ended_are_dropped() -> None:
    """News after the loop has ended are dropped."""
    cell = FakeCell(shipped_cell("default"))

    async def scenario() -> None:
        async def show(state: CellState) -> None:
            del state

        Hub(cell).add(show)

    asyncio.run(scenario())
    news(cell, 1)


def test_a_moving_arm_waits_for_the_pause_and_a_question_does_not() -> None:
    """A moving arm waits for the pause and a question does not."""

    async def scenario() -> list[tuple[float, ...]]:
        cell, shown = FakeCell(shipped_cell("default")), []
        pause = asyncio.Event()

        async def show(state: CellState) -> None:
            shown.append(state.joints)

        async def sleep(seconds: float) -> None:
            if seconds > LEAST:
                await pause.wait()

        hub = Hub(cell, sleep)
        task = asyncio.create_task(hub.add(show, pause=0.1).run())
        await settled()
        cell.tell(replace(cell.told, joints=(1.0,)))
        await settled()
        shown.clear()
        cell.tell(replace(cell.told, joints=(2.0,)))
        await settled()
        assert shown == []
        cell.tell(replace(cell.told, mode=Mode.HELD, joints=(3.0,)))
        await settled()
        task.cancel()
        return shown

    assert asyncio.run(scenario()) == [(3.0,)]
