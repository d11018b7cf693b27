"""The chain of digests: every event vouches for all before it.

    digest(0) = 16 zero bytes
    digest(n) = blake2b-16(digest(n - 1), n, at, length of kind, kind, body)

A changed, missing, added or moved event breaks the chain at its number. The chain has no key: it
shows damage and careless edits, not a forger who computes all later digests anew.
"""

import struct
from collections.abc import Iterable, Iterator, Sequence
from hashlib import blake2b

from depal.errors import JournalError
from depal.executive.journal.records import Entry, Record

SIZE = 16
GENESIS = bytes(SIZE)

Row = tuple[int, float, bytes, bytes, bytes]
"""sequence, at, kind, body, digest: as they stand in the file."""

NewRow = tuple[int, float, str, str, bytes]
"""The same, to be written."""

REMEDY = (
    "keep the files for study, restore the latest backup or begin a new journal, "
    "and look at the world again before anything moves"
)

_pack = struct.Struct("<16sqdq").pack
_pack_covered = struct.Struct("<16sq").pack


def link(previous: bytes, sequence: int, at: float, kind: bytes, body: bytes) -> bytes:
    """The digest of one event, given that of the event before it."""
    head = _pack(previous, sequence, at, len(kind))
    return blake2b(head + kind + body, digest_size=SIZE).digest()


def seal(digest: bytes, sequence: int, packed: bytes) -> bytes:
    """The digest of a snapshot; it holds for these events only.

    Args:
        digest: the digest of the last event that it covers.
        sequence: that event's number.
        packed: the snapshot's body, compressed.
    """
    return blake2b(_pack_covered(digest, sequence) + packed, digest_size=SIZE).digest()


def sealed(digest: bytes, sequence: int, packed: bytes, found: bytes) -> bool:
    """Whether a snapshot is as it was written; in a damaged file it may be of any type."""
    try:
        return seal(digest, sequence, packed) == found
    except (TypeError, struct.error):
        return False


def forge(previous: bytes, last: int, entries: Sequence[Entry]) -> list[NewRow]:
    """The rows that continue a chain.

    Args:
        previous: the digest of the last event.
        last: its number.
        entries: the events to be added, already checked.
    """
    rows: list[NewRow] = []
    for sequence, (at, kind, body) in enumerate(entries, last + 1):
        previous = link(previous, sequence, at, kind.encode(), body.encode())
        rows.append((sequence, at, kind, body, previous))
    return rows


def walk(source: str, previous: bytes, after: int, rows: Iterable[Row]) -> Iterator[Record]:
    """The records of rows that continue a chain, each checked before it is handed out.

    Args:
        source: the journal's name, for the error.
        previous: the digest of the event before the first row.
        after: the number of that event.
        rows: what stands in the file.

    Raises:
        JournalError: an event is missing or was edited.
    """
    expected = after
    for sequence, at, kind, body, digest in rows:
        expected += 1
        if sequence != expected:
            raise damaged(source, expected, "is missing")
        try:
            previous = link(previous, sequence, at, kind, body)
        except (TypeError, struct.error) as error:
            raise damaged(source, sequence, "is not an event any more") from error
        if previous != digest:
            raise damaged(source, sequence, "is not as it was written")
        yield Record(sequence, at, str(kind, "utf-8"), str(body, "utf-8"))


def damaged(source: str, sequence: int, what: str) -> JournalError:
    """The error about an event that cannot be trusted."""
    before = f"the events up to {sequence - 1} hold" if sequence > 1 else "no event before it"
    return JournalError(f"{source}: event {sequence} {what} ({before}); {REMEDY}")
