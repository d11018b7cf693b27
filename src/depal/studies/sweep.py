"""Many independent pieces of work, on whatever there is to do them."""

import re
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import get_context
from typing import TypeVar, cast

from depal.errors import DepalError, MissingPartError, SettingError

T = TypeVar("T")
R = TypeVar("R")

Progress = Callable[[int, int], None]
"""Told how many pieces are done, of how many."""


def no_progress(done: int, total: int) -> None:
    """Says nothing."""
    del done, total


def sweep(
    work: Callable[[T], R],
    pieces: Sequence[T],
    executor: Executor | None = None,
    progress: Progress = no_progress,
    heard: Callable[[int, R], None] = lambda _piece, _result: None,
) -> list[R]:
    """Does every piece and returns the results in the order of the pieces.

    Args:
        work: a pure function that pickles; it gets one piece.
        pieces: what to work on; each carries its own seed, so that the results depend neither
            on the number of workers nor on who is first.
        executor: any executor; None works in this process.
        progress: called after each piece.
        heard: called with each result as soon as it is there, and with its piece's place.

    Returns:
        One result a piece.

    Raises:
        DepalError: a worker process died.
    """

    def ended(index: int, result: R, done: int) -> None:
        results[index] = result
        heard(index, result)
        progress(done, len(pieces))

    results: list[R | None] = [None] * len(pieces)
    progress(0, len(pieces))
    if executor is None:
        for index, piece in enumerate(pieces):
            ended(index, work(piece), index + 1)
    else:
        futures = {executor.submit(work, piece): index for index, piece in enumerate(pieces)}
        try:
            for done, future in enumerate(as_completed(futures), start=1):
                ended(futures[future], future.result(), done)
        except BrokenExecutor as error:
            message = "a worker process died; fewer --workers need less memory"
            raise DepalError(message) from error
    return cast("list[R]", results)


@contextmanager
def executor_for(workers: int, dask: str | None = None) -> Iterator[Executor | None]:
    """The executor that the options ask for.

    Args:
        workers: how many processes; 1 works in this process.
        dask: the address of a Dask scheduler, which wins over `workers`.

    Yields:
        The executor, or None for this process.

    Raises:
        SettingError: the number of workers is not positive, or no scheduler answers.
        MissingPartError: Dask is asked for and not installed.
    """
    if dask is not None:
        with _dask_executor(dask) as executor:
            yield executor
        return
    if workers < 1:
        raise SettingError("--workers", f"{workers} workers cannot work", "1 or more")
    if workers == 1:
        yield None
        return
    # Spawned, not forked: a fork would copy the progress bar's thread in whatever state it is.
    context = get_context("spawn")
    with ProcessPoolExecutor(workers, context, _end_when_interrupted) as executor:
        try:
            yield executor
        except BaseException:
            executor.shutdown(wait=False, cancel_futures=True)
            raise


def _end_when_interrupted() -> None:
    """Of a worker: Ctrl-C ends it at once, with what it works on and what would come next."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@contextmanager
def _dask_executor(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client  # noqa: PLC0415 - an extra
    except ImportError as error:
        message = "Dask is not installed; pip install 'depal[dask]'"
        raise MissingPartError(message) from error
    if not re.fullmatch(r"(tcp|tls|ws|wss|ucx|inproc)://\S+", address):
        what = f"{address!r} is no address of a Dask scheduler"
        raise SettingError("--dask", what, "tcp://HOST:PORT or tls://HOST:PORT")
    try:
        client = Client(address, timeout="10s", set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError) as error:
        what = f"no Dask scheduler answers at {address}"
        raise SettingError("--dask", what, "the address that `dask scheduler` prints") from error
    with client:
        yield cast("Executor", client.get_executor(pure=False))  # type: ignore[no-untyped-call]
