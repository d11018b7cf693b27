"""Drawings say everything that a tree says, and nothing overlaps in them."""

from importlib.resources import files
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.executive.conditions import FactRef, Holds, Literal, Value, at_once
from depal.executive.drawing import tree_mermaid, tree_svg, tree_text
from depal.executive.drawing.layout import Placed, Rect, layout
from depal.executive.drawing.words import drawn
from depal.executive.language import read_tasks
from depal.executive.schema import Action, Repository, Step, Task
from depal.executive.tree import Standing, Tree, ground, sweep

STORE = read_tasks(Path(str(files("depal.cell.tasks") / "store.task")))
SVG = "{http://www.w3.org/2000/svg}"

HELD: dict[str, Value] = {"b1.taken": True, "kr60.at": "b1"}


def store(facts: dict[str, Value] = HELD) -> tuple[Tree, list[Standing]]:
    """The running example in some state."""
    tree = ground(STORE, "store", ["b1"])
    return tree, sweep(tree, facts, at_once)


@pytest.mark.parametrize("draw", [tree_text, tree_svg, tree_mermaid])
@pytest.mark.parametrize("stated", [True, False])
def test_every_node_and_every_state_is_drawn(draw: type, stated: bool) -> None:  # noqa: FBT001 - a parameter of the test
    """By its label and in words."""
    tree, standings = store()
    text = draw(tree, standings if stated else None)
    assert all(node.label in text for node in tree.nodes)
    for word in ("accomplished", "disabled", "enabled, may run"):
        assert (word in text) is stated


def test_the_text_of_a_schema_is_the_tree_of_the_paper() -> None:
    """Dashed lines lead to what is abstract."""
    assert tree_text(ground(STORE, "store", ["Box"])) == (
        "store(Box)               when not Box.on_floor, within not cell.suspended, "
        "limit speed cell.speed\n"
        "├╌ take(Box)\n"
        "│  ├─ kr60_reach(Box)\n"
        "│  └─ kr60_grasp(Box)    when kr60.at = Box\n"
        "├╌ check(Box)            when Box.taken and not Box.known\n"
        "│  ├─ kr60_show(Box)\n"
        "│  └─ read_barcode(Box)  when kr60.at = reader\n"
        "├╌ query(Box)            when Box.known and not Box.target\n"
        "│  └─ ask_target(Box)\n"
        "└╌ leave(Box)            when Box.taken and Box.target\n"
        "   ├─ kr60_carry(Box)\n"
        "   └─ kr60_release(Box)  when kr60.at = Box.target\n"
    )


def test_the_text_marks_states_and_conditions() -> None:
    """With signs beside the words."""
    text = tree_text(*store())
    assert "├╌ take(b1)             ✓ accomplished\n" in text
    assert "│  ├─ kr60_show(b1)     ▶ enabled, may run\n" in text
    assert "✗ disabled          ✗ when kr60.at = reader\n" in text


def test_what_is_accomplished_above_lets_the_rest_stand_still() -> None:
    """Enabled, but nothing comes of it."""
    assert "kr60_reach(b1)    ○ enabled, at rest" in tree_text(
        *store({"b1.taken": True, "kr60.at": "reader"})
    )


def test_abstract_ovals_are_dashed_and_concrete_ones_continuous() -> None:
    """As in Fig. 3."""
    tree, standings = store()
    root = ET.fromstring(tree_svg(tree, standings, "A box"))  # noqa: S314 - our own text
    groups = [group for group in root.iter(f"{SVG}g") if group.find(f"{SVG}title") is not None]
    assert len(groups) == len(tree.nodes)
    for group, node in zip(groups, tree.nodes, strict=True):
        oval = group.find(f"{SVG}ellipse")
        assert oval is not None
        assert ("stroke-dasharray" in oval.attrib) is not node.concrete


def test_the_colours_are_those_of_the_paper() -> None:
    """Green enabled, blue accomplished, red disabled: the strongest channel of each fill."""
    tree, standings = store()
    root = ET.fromstring(tree_svg(tree, standings))  # noqa: S314 - our own text
    strongest = {"enabled": 1, "accomplished": 2, "disabled": 0}
    ovals = [
        oval
        for group in root.iter(f"{SVG}g")
        if group.find(f"{SVG}title") is not None
        and (oval := group.find(f"{SVG}ellipse")) is not None
    ]
    for oval, standing in zip(ovals, standings, strict=True):
        line = oval.attrib["stroke"]
        channels = [int(line[at : at + 2], 16) for at in (1, 3, 5)]
        assert channels.index(max(channels)) == strongest[standing.state.value]


def test_mermaid_gives_every_node_its_class() -> None:
    """Of its state, and dashes to what is abstract."""
    chart = tree_mermaid(*store())
    assert chart.startswith("flowchart TD\n")
    assert '    n0 -->|"✓ b1.taken and not b1.known"| n4\n' in chart
    assert "    class n1,n2,n3 accomplished\n" in chart
    assert "    class n0,n1,n4,n7,n9 abstract\n" in chart


names = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12)


@given(names, names)
def test_whatever_a_name_holds_the_picture_is_well_formed(name: str, thing: str) -> None:
    """Signs that mean something to XML or to Mermaid are escaped."""
    done = Holds(FactRef(Literal("x"), "done"))
    step = Step("!act", (), Holds(FactRef(Literal("x"), "on")))
    schemata = {name: Task(name, (), (step,), done), "!act": Action("!act", (), done)}
    tree = ground(Repository({}, {}, schemata), name, [])
    root = ET.fromstring(tree_svg(tree, sweep(tree, {}, at_once), title=thing))  # noqa: S314 - our own text
    assert root.tag == f"{SVG}svg"
    chart = tree_mermaid(tree)
    assert chart.count('"') == 6
    assert all(sign not in chart.split('"')[1] for sign in '<>&"')


def _tree(shape: list[int], conditions: list[bool]) -> Tree:
    """A tree in which node i hangs below node shape[i - 1] modulo i."""
    below: dict[int, list[int]] = {}
    for child, above in enumerate(shape, start=1):
        below.setdefault(above % child, []).append(child)
    when = Holds(FactRef(Literal("something_long"), "with_a_long_name"))
    until = Holds(FactRef(Literal("x"), "done"))
    schemata: dict[str, Task | Action] = {}
    for index in range(len(shape) + 1):
        name = f"node_{index}" * (1 + index % 3)
        steps = tuple(
            Step(f"node_{child}" * (1 + child % 3), (), when)
            if conditions[child % len(conditions)]
            else Step(f"node_{child}" * (1 + child % 3), ())
            for child in below.get(index, [])
        )
        schemata[name] = Task(name, (), steps, until) if steps else Action(name, (), until)
    return ground(Repository({}, {}, schemata), "node_0", [])


def _boxes(placed: tuple[Placed, ...]) -> list[Rect]:
    return [box for one in placed for box in (one.oval, one.note) if box is not None]


@given(
    st.lists(st.integers(0, 30), min_size=1, max_size=14),
    st.lists(st.booleans(), min_size=1, max_size=5),
)
def test_nothing_overlaps_and_everything_is_inside(
    shape: list[int], conditions: list[bool]
) -> None:
    """Ovals and conditions, for trees of any shape."""
    found = layout(drawn(_tree(shape, conditions), None), 40.0)
    boxes = _boxes(found.nodes)
    for one, other in combinations(boxes, 2):
        apart = one.right <= other.left or other.right <= one.left
        assert apart or one.bottom <= other.top or other.bottom <= one.top
    assert all(box.left >= 0 and box.right <= found.width for box in boxes)
    assert all(box.top >= 40.0 and box.bottom <= 40.0 + found.height for box in boxes)
