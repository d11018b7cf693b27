"""The engine that a journal leads to: the last snapshot, and every event after it."""

import gc
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from depal.errors import JournalError
from depal.executive.emphasis import EmphasisWeights
from depal.executive.engine import DEFAULT_WEIGHTS, Engine
from depal.executive.events import Allocated, Event, decoded
from depal.executive.journal import Journal
from depal.executive.schema import Repository
from depal.executive.snapshot import thaw


def restored(
    repository: Repository, events: Iterable[Event], weights: EmphasisWeights = DEFAULT_WEIGHTS
) -> Engine:
    """The engine that events lead to, from the beginning.

    Args:
        repository: the schemata that the events were made with.
        events: all of them, in order.
        weights: of the emphasis.

    Returns:
        The engine; call `restart` before anything else.

    Raises:
        JournalError: a tree was allocated from other task files.
    """
    engine = Engine(repository, weights)
    with _no_collection():
        for event in events:
            _fold(engine, event)
    return engine


def resumed(
    repository: Repository, journal: Journal, weights: EmphasisWeights = DEFAULT_WEIGHTS
) -> Engine:
    """The engine that a journal leads to, by its last snapshot where it has one.

    Args:
        repository: the schemata that the journal was written with.
        journal: read, not changed.
        weights: of the emphasis.

    Returns:
        The engine; call `restart` before anything else.

    Raises:
        JournalError: the journal is damaged, or was written with other task files.
    """
    engine = Engine(repository, weights)
    snapshot = journal.snapshot()
    with _no_collection():
        if snapshot is not None:
            engine.state = thaw(repository, weights, snapshot.body)
        after = 0 if snapshot is None else snapshot.sequence
        for event in decoded(journal.read(after)):
            _fold(engine, event)
    return engine


def _fold(engine: Engine, event: Event) -> None:
    if isinstance(event, Allocated) and event.digest != engine.repository.digest:
        message = (
            f"tree {event.tree}, {event.schema}({', '.join(event.args)}), was allocated from other "
            f"task files ({event.digest}, now {engine.repository.digest}); expected the files that "
            "the journal was written with"
        )
        raise JournalError(message)
    engine.state.apply(event)


@contextmanager
def _no_collection() -> Iterator[None]:
    """Folding makes many objects that stay; looking for garbage among them takes longer."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
