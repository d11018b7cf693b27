"""Whether the note agrees with itself, and the stack with the note."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from depal.errors import PRINTED
from depal.geometry import Vector3
from depal.logistics.findings import Finding, choices
from depal.logistics.gtin import same_article
from depal.logistics.parts import ROUNDING, TOLERANCE, NotePart, StackPart


def products_on_two_lines(note: Sequence[NotePart]) -> Iterator[Finding]:
    """Every line whose product an earlier line has, even with other leading zeros.

    Args:
        note: the lines.

    Yields:
        One finding per such line.
    """
    first: dict[str, int] = {}
    for line in note:
        if line.gtin is not None:
            earlier = first.setdefault(same_article(line.gtin), line.index)
            if earlier != line.index:
                yield Finding(
                    ("lines", line.index, "gtin"),
                    f"'{line.gtin}' is already on",
                    "each product on one line",
                    twin=("lines", earlier),
                )


def counts_that_differ(note: Sequence[NotePart], stack: Sequence[StackPart]) -> Iterator[Finding]:
    """Every product of which the stack has more or fewer cases than the note promises.

    Cases whose product could not be read may be the ones that are short.

    Args:
        note: the lines.
        stack: the stacked cases.

    Yields:
        One finding per product, at the count of its first line.
    """
    stacked = Counter(case.gtin for case in stack)
    unread = stacked[None]
    lines_of: dict[str, list[NotePart]] = defaultdict(list)
    for line in note:
        if line.gtin is not None:
            lines_of[line.gtin].append(line)
    for gtin, lines in lines_of.items():
        counts = [line.count for line in lines if line.count is not None]
        promised, found = sum(counts), stacked[gtin]
        if len(counts) == len(lines) and not promised - unread <= found <= promised:
            what = f"the note says {promised}, the stack has {found} of '{gtin}'"
            yield Finding(("lines", lines[0].index, "count"), what, "as many in both")


def products_not_on_the_note(
    note: Sequence[NotePart], stack: Sequence[StackPart]
) -> Iterator[Finding]:
    """Every stacked case whose product the note does not have.

    Lines whose product could not be read may be the ones that are missing.

    Args:
        note: the lines.
        stack: the stacked cases.

    Yields:
        One finding per case.
    """
    known = [line.gtin for line in note if line.gtin is not None]
    on_note = set(known)
    strangers = [case for case in stack if case.gtin is not None and case.gtin not in on_note]
    if len({case.gtin for case in strangers}) <= len(note) - len(known):
        return
    for number, case in enumerate(strangers):
        exists = choices(str(case.gtin), known) if number < PRINTED else ""
        what = f"'{case.gtin}' is not on the note"
        yield Finding(("stack", case.index, "gtin"), what, "a product of the note", exists)


def sizes_that_are_no_turn(
    note: Sequence[NotePart], stack: Sequence[StackPart]
) -> Iterator[Finding]:
    """Every stacked case whose edges are not those of its product, in whatever order.

    Args:
        note: the lines.
        stack: the stacked cases.

    Yields:
        One finding per case.
    """
    size_of: dict[str, Vector3 | None] = {}
    for line in note:
        if line.gtin is not None:
            size_of.setdefault(line.gtin, line.size)
    for case in stack:
        size = size_of.get(case.gtin) if case.gtin is not None else None
        if size is None or case.size is None or _is_turn(case.size, size):
            continue
        what = f"{_edges(case.size)} is no turn of the product"
        expected = f"{_edges(size)} in any order, within 1 mm"
        yield Finding(("stack", case.index, "size"), what, expected)


def _is_turn(turned: Vector3, size: Vector3) -> bool:
    pairs = zip(sorted(turned), sorted(size), strict=True)
    return all(abs(one - other) <= TOLERANCE + ROUNDING for one, other in pairs)


def _edges(size: Vector3) -> str:
    return " x ".join(f"{edge:.6g}" for edge in size) + " m"
