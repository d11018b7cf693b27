"""The boxes on the pallet in the order of the last selection, with the reason for each."""

from depal.server.cellstate import CellState, QueueLine
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.panels.marks import SHAPES, TINTS, Mark, marks_of
from depal.server.screen.said import Said
from depal.server.screen.words import Words

COLUMNS = ("box", "product", "h", "l", "s", "fate")


def queue_table(state: CellState, words: Words, said: Said) -> Markup:
    """A table; the target comes first in the eye by shape and word."""
    if not state.queue:
        return tag("p", words("queue.empty"), cls="quiet")
    marks = marks_of(state)
    heads = joined(
        tag(
            "th",
            words(f"queue.{column}"),
            scope="col",
            cls="num" if column in {"h", "l", "s"} else None,
            title=words(f"queue.{column}_means") if column in {"h", "l", "s"} else None,
        )
        for column in COLUMNS
    )
    rows = joined(_row(line, marks[line.box], words, said) for line in state.queue)
    caption = tag("caption", words("queue.caption"), cls="unseen")
    return tag("table", caption, tag("thead", tag("tr", heads)), tag("tbody", rows), cls="queue")


def _row(line: QueueLine, mark: Mark, words: Words, said: Said) -> Markup:
    product = line.name or line.gtin or words("queue.unknown")
    sign = marked(mark, words)
    return tag(
        "tr",
        tag("th", line.box, " ", sign, scope="row"),
        tag("td", product, cls="name", title=product),
        tag("td", f"{line.h:.2f}", cls="num"),
        tag("td", f"{line.l:.2f}", cls="num"),
        tag("td", f"{line.s:.2f}", cls="num"),
        tag("td", said(line.reason), cls="reason"),
        cls=f"is-{mark.value}",
    )


def marked(mark: Mark, words: Words) -> Markup | None:
    """A mark as shape and word in its tint."""
    if mark is Mark.PLAIN:
        return None
    tint = TINTS[mark]
    look = f"background:{tint.fill};color:{tint.text};border-color:{tint.line}"
    word = f"{SHAPES[mark]} {words(f'mark.{mark.value}')}"
    return tag("span", word, cls="mark", style=look)
