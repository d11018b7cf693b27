"""Files that people choose: read in the browser, brought in pieces, one use case at the end."""

import base64
import binascii
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass

from nicegui import events, ui

from depal.server.screen.markup import NOTHING, Markup, joined, tag
from depal.server.screen.toast import refused
from depal.server.screen.words import Words

ACCEPT = ".json,.csv,application/json,text/csv"
"""Of delivery files."""

PIECE = 200_000
"""Letters in one message."""

MOST = 5_000_000
"""No file is larger [bytes]."""

PICK = """
() => {
  const input = document.createElement('input');
  input.type = 'file';
  input.accept = %(accept)r;
  input.onchange = () => {
    const file = input.files[0];
    if (!file) return;
    const name = 'file-%(id)s';
    if (file.size > %(most)d) { emitEvent(name, {name: file.name, size: file.size}); return; }
    const reader = new FileReader();
    reader.onload = () => {
      const all = reader.result.split(',', 2)[1] || '';
      const count = Math.max(1, Math.ceil(all.length / %(piece)d));
      for (let i = 0; i < count; i++)
        emitEvent(name, {name: file.name, size: file.size, part: i, count: count,
          data: all.slice(i * %(piece)d, (i + 1) * %(piece)d)});
    };
    reader.readAsDataURL(file);
  };
  input.click();
}
"""

Bring = Callable[[str, bytes], Awaitable[None]]


@dataclass(slots=True)
class Coming:
    """A file on its way.

    Attributes:
        parts: that have come, in order.
    """

    parts: list[str]


def choose(button: ui.button, accept: str, too_large: str, bring: Bring) -> None:
    """Makes a button open the browser's own chooser.

    Args:
        button: that is pressed.
        accept: which files, as HTML's `accept`.
        too_large: what is said of a file that is larger than allowed.
        bring: is given the name and the content.
    """
    coming = Coming([])
    values = {"id": button.id, "accept": accept, "most": MOST, "piece": PIECE}

    async def came(event: events.GenericEventArguments) -> None:
        told = event.args
        part, data = told.get("part"), told.get("data")
        if not isinstance(part, int) or not isinstance(data, str) or len(data) > PIECE:
            refused(too_large)
            return
        if part == 0:
            coming.parts.clear()
        if part != len(coming.parts) or part * PIECE > 2 * MOST:
            return
        coming.parts.append(data)
        if len(coming.parts) < int(told.get("count", 1)):
            return
        try:
            content = base64.b64decode("".join(coming.parts), validate=True)
        except binascii.Error:
            return
        finally:
            coming.parts.clear()
        await bring(str(told.get("name", ""))[:200], content)

    ui.on(f"file-{button.id}", came)
    button.on("click", js_handler=PICK % values)


def problems(found: Sequence[str], words: Words) -> Markup:
    """Everything that is wrong with a file, as a list."""
    if not found:
        return NOTHING
    items = joined(tag("li", problem) for problem in found)
    title = tag("strong", words("file.problems", count=len(found)))
    return tag("div", title, tag("ul", items), cls="problems", role="alert")
