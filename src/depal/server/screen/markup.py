"""Markup that cannot be broken out of: every text and every attribute is escaped."""

from collections.abc import Iterable
from html import escape
from typing import Final


class Markup(str):
    """A piece of HTML or SVG that this module has made; all other strings are escaped."""

    __slots__ = ()


Content = str | float | None

NOTHING: Final = Markup()

ALONE = frozenset(
    {"br", "img", "input", "link", "meta", "rect", "line", "circle", "path", "polygon", "polyline"}
)
"""Elements without content."""


def tag(name: str, /, *content: Content, **attributes: Content) -> Markup:
    """One element.

    Args:
        name: of the element; never from outside.
        content: markup as it is, all else escaped; None is left out.
        attributes: None is left out; `cls` is `class`, underscores become dashes.
    """
    given = "".join(
        f' {_name(key)}="{escape(str(value), quote=True)}"'
        for key, value in attributes.items()
        if value is not None
    )
    if name in ALONE:
        return Markup(f"<{name}{given}/>")
    return Markup(f"<{name}{given}>{joined(content)}</{name}>")


def text(content: Content) -> Markup:
    """Escaped, unless it is markup already."""
    if isinstance(content, Markup):
        return content
    return NOTHING if content is None else Markup(escape(str(content), quote=True))


def joined(parts: Iterable[Content]) -> Markup:
    """One after the other."""
    return Markup("".join(text(part) for part in parts))


def icon(name: str) -> Markup:
    """A picture beside a word; read to nobody."""
    return tag("i", name, cls="q-icon material-icons", aria_hidden="true")


def _name(key: str) -> str:
    """An attribute's name for a keyword: `cls`, `viewBox`, `aria_label`, `for_`."""
    return "class" if key == "cls" else key.rstrip("_").replace("_", "-")
