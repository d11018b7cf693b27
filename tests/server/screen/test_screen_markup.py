"""Foreign text is never markup."""

import ast
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from screenstates import line, state_with

from depal.server.screen.files import problems
from depal.server.screen.markup import Markup, tag, text
from depal.server.screen.panels.alarms import alarms
from depal.server.screen.panels.queue import queue_table
from depal.server.screen.said import said_in
from depal.server.screen.words import words_of

HOSTILE = (
    "<img src=x onerror=alert(1)>",
    "</td></tr></table><script>alert(1)</script>",
    '" onmouseover="alert(1)',
    "' autofocus onfocus='alert(1)",
    "&lt;b&gt; {{7*7}} {0}",
    "\u202egnp.exe",
    "javascript:alert(1)",
)

WORDS, SAID = words_of("en"), said_in("en")


class Reader(HTMLParser):
    """What a browser would make of it."""

    def __init__(self) -> None:
        """Nothing yet."""
        super().__init__()
        self.tags: list[str] = []
        self.names: set[str] = set()
        self.texts: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """An element begins."""
        self.tags.append(tag)
        self.names.update(name for name, _ in attrs)

    def handle_data(self, data: str) -> None:
        """A text."""
        self.texts.append(data)


def read(markup: str) -> Reader:
    """Markup as a browser reads it."""
    reader = Reader()
    reader.feed(markup)
    reader.close()
    return reader


@given(st.text(alphabet=st.characters(exclude_categories=["Cs", "Cc"])))
def test_text_comes_out_as_it_went_in_and_makes_no_element(foreign: str) -> None:
    """Text comes out as it went in and makes no element."""
    reader = read(tag("p", foreign, title=foreign))
    assert reader.tags == ["p"]
    assert reader.names == {"title"}
    assert "".join(reader.texts) == foreign


def test_markup_is_not_escaped_twice() -> None:
    """Markup is not escaped twice."""
    inner = tag("b", "a < b")
    assert tag("p", inner) == "<p><b>a &lt; b</b></p>"
    assert text(inner) is inner


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_product_name_is_a_text_in_the_queue(name: str) -> None:
    """A hostile product name is a text in the queue."""
    state = state_with(line("b1", name=name, reason=name))
    reader = read(queue_table(state, WORDS, SAID))
    assert set(reader.tags) == {"table", "caption", "thead", "tbody", "tr", "th", "td"}
    assert {n for n in reader.names if n.startswith("on")} == set()
    assert name in reader.texts


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_problem_or_alarm_is_a_text(name: str) -> None:
    """A hostile problem or alarm is a text."""
    from depal.server.cellstate import Alarm, CellState  # noqa: PLC0415

    told = CellState(alarms=(Alarm("x", name, name, 0.0),))
    for markup in (problems([name], WORDS), alarms(told, "", WORDS, SAID)):
        reader = read(markup)
        assert {"img", "script"} & set(reader.tags) == set()
        assert {n for n in reader.names if n.startswith("on")} == set()


def test_only_one_module_puts_markup_into_pages() -> None:
    """And that one escapes: see `pane.html` and `pane.put`."""
    for path in Path(str(files("depal.server.screen"))).rglob("*.py"):
        tree = ast.parse(path.read_text("utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and path.name != "pane.py":
                assert node.attr not in {"html", "content", "inner_html"} or is_harmless(node), path


def is_harmless(node: ast.Attribute) -> bool:
    """Reading an attribute of something that is no page."""
    return isinstance(node.ctx, ast.Load) and ast.unparse(node.value) != "ui"


def test_markup_is_made_by_its_own_module_alone() -> None:
    """Markup is made by its own module alone."""
    for path in Path(str(files("depal.server.screen"))).rglob("*.py"):
        if path.name == "markup.py":
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "Markup":
                assert node.args == [], path
    assert Markup() == ""
