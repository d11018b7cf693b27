"""A sweep gives the same on any executor."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from depal.errors import DepalError, MissingPartError, SettingError
from depal.studies.sweep import executor_for, sweep
from depal.studies.table1 import table1


def square(number: int) -> int:
    """A piece of work."""
    return number * number


def test_results_come_in_the_order_of_the_pieces_and_progress_to_its_end() -> None:
    """Whoever is first."""
    told: list[tuple[int, int]] = []
    with ThreadPoolExecutor(4) as executor:
        results = sweep(square, range(50), executor, lambda *now: told.append(now))
    assert results == [number * number for number in range(50)]
    assert told[0] == (0, 50)
    assert told[-1] == (50, 50)


def test_every_result_is_heard_as_soon_as_it_is_there_with_its_piece() -> None:
    """Before the progress is told, whoever is first."""
    with ThreadPoolExecutor(4) as executor:
        for where in (None, executor):
            heard: dict[int, int] = {}
            told: list[tuple[int, int]] = []

            def tell(done: int, _: int) -> None:
                told.append((done, len(heard)))  # noqa: B023 - called within the turn

            sweep(square, range(9), where, tell, heard.__setitem__)
            assert heard == {number: number * number for number in range(9)}
            assert told == [(done, done) for done in range(10)]


def die(_: int) -> int:
    """As a process ends that the system kills."""
    os._exit(1)


@pytest.mark.slow
def test_a_worker_that_dies_is_one_clear_error() -> None:
    """And no wait for the pieces that are left."""
    with pytest.raises(DepalError) as caught, executor_for(2) as executor:
        sweep(die, range(4), executor)
    assert str(caught.value) == "a worker process died; fewer --workers need less memory"


@pytest.mark.slow
def test_an_interrupted_sweep_leaves_the_rest_undone(tmp_path: Path) -> None:
    """What waits in the queue is given up when something goes wrong outside."""
    pieces = [tmp_path / str(number) for number in range(100)]

    def stop(_: int, __: None) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), executor_for(2) as executor:
        sweep(touch_slowly, pieces, executor, heard=stop)
    assert sum(piece.exists() for piece in pieces) < 50


def touch_slowly(path: Path) -> None:
    """A piece of work that leaves a trace."""
    sum(range(300_000))
    path.touch()


def test_the_table_does_not_depend_on_the_number_of_workers() -> None:
    """In this process and in two others: the same to the last bit."""
    alone = table1(600, seed=3)
    with executor_for(2) as executor:
        together = table1(600, seed=3, executor=executor)
    assert together == alone


def test_a_dask_cluster_gives_the_same_table() -> None:
    """Through the address of its scheduler."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None, protocol="tcp"
    )
    with cluster, executor_for(1, cluster.scheduler_address) as executor:
        together = table1(300, seed=3, executor=executor)
    assert together == table1(300, seed=3)


def test_a_trial_does_not_depend_on_how_many_there_are() -> None:
    """The first of many are the many's first."""
    from depal.studies.case1 import run_case1  # noqa: PLC0415 - only here

    few, many = (run_case1("guillotine", (0.5,), n, seed=1) for n in (40, 300))
    assert few.h.tolist() == many.h[:40].tolist()
    assert few.hl.tolist() == many.hl[:40].tolist()


def test_no_workers_are_refused() -> None:
    """One clear error."""
    with pytest.raises(SettingError) as caught, executor_for(0):
        pass
    assert str(caught.value) == "--workers: 0 workers cannot work; expected 1 or more"


def test_an_address_that_is_none_is_refused() -> None:
    """Before any work begins."""
    pytest.importorskip("distributed")
    for address in ("nonsense", "", "http://x", "x:y"):
        with pytest.raises(SettingError) as caught, executor_for(1, address):
            pass
        assert str(caught.value) == (
            f"--dask: {address!r} is no address of a Dask scheduler; "
            "expected tcp://HOST:PORT or tls://HOST:PORT"
        )


def test_dask_that_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the command that installs it."""
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(MissingPartError, match="pip install"), executor_for(1, "tcp://x:1"):
        pass
