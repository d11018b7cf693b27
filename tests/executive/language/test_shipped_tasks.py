"""The task files that ship with the package."""

from importlib import resources
from pathlib import Path

import pytest

from depal.executive.conditions import FactRef, Literal, Var, facts_of
from depal.executive.language import format_repository, parse, parse_term, read_tasks
from depal.executive.schema import Action, Cancel, Repository, Task

FOLDER = Path(str(resources.files("depal.cell.tasks")))
FILES = sorted(FOLDER.glob("*.task"))
PAPER = """schema(store(Box), <
    (take(Box), true),
    (check(Box), Box.taken ^ not Box.known),
    (query(Box), Box.known ^ not Box.target),
    (leave(Box), Box.taken ^ Box.target)>, Box.stored)"""


@pytest.fixture(scope="module")
def cell() -> Repository:
    """All shipped files as one repository."""
    return read_tasks(FILES)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_shipped_files_are_canonical(path: Path) -> None:
    """Formatting changes nothing, and no line is too long."""
    text = path.read_text("utf-8")
    assert format_repository(parse(text)) == text
    assert max(map(len, text.splitlines())) <= 100


def test_the_term_of_the_paper_is_the_shipped_task(cell: Repository) -> None:
    """Section II-B's store(Box), step by step."""
    term, store = parse_term(PAPER), cell.schemata["store"]
    assert isinstance(store, Task)
    assert store.steps == term.steps
    assert store.until == term.until
    assert store.params == term.params


def test_store_has_the_size_of_the_figure(cell: Repository) -> None:
    """Figure 3: 4 abstract subtasks and 7 concrete actions, 5 of them of the robot."""
    store = cell.schemata["store"]
    assert isinstance(store, Task)
    subtasks = [cell.schemata[step.schema] for step in store.steps]
    actions = [step.schema for task in subtasks if isinstance(task, Task) for step in task.steps]
    assert [task.name for task in subtasks] == ["take", "check", "query", "leave"]
    assert len(set(actions)) == 7
    assert sum(name.startswith("kr60_") for name in actions) == 5


def test_all_that_is_mentioned_is_declared(cell: Repository) -> None:
    """Subtasks with as many arguments, facts by sort or by thing, and resources."""
    for schema in cell.schemata.values():
        sorts = {param.name: param.sort for param in schema.params}
        mentioned = [*facts_of(schema.until), *facts_of(schema.when)]
        resources_named = schema.keeps if isinstance(schema, Task) else schema.uses
        if isinstance(schema, Task):
            for step in schema.steps:
                mentioned += facts_of(step.when)
                assert len(cell.schemata[step.schema].params) == len(step.args)
        else:
            mentioned += schema.sets
        assert set(resources_named) <= set(cell.resources)
        assert {declared(fact, sorts) for fact in mentioned} <= set(cell.facts)


def declared(fact: FactRef, sorts: dict[str, str]) -> str:
    """The name under which a fact is declared."""
    match fact.subject:
        case Var(name):
            return f"{sorts[name]}.{fact.attribute}"
        case Literal(thing):
            return f"{thing}.{fact.attribute}"


def test_every_action_can_make_its_own_postcondition_true(cell: Repository) -> None:
    """Each fact of until is among the facts that it sets, but for the right side of a target."""
    for action in cell.schemata.values():
        if isinstance(action, Action):
            left = set(facts_of(action.until)) - {FactRef(Var("Box"), "target")}
            assert left <= set(action.sets), action.name


def test_every_action_belongs_to_a_task(cell: Repository) -> None:
    """Nothing in the files is out of reach."""
    called = {
        step.schema
        for task in cell.schemata.values()
        if isinstance(task, Task)
        for step in task.steps
    }
    actions = {name for name, schema in cell.schemata.items() if isinstance(schema, Action)}
    roots = {name for name in cell.schemata if name not in called}
    assert actions <= called
    assert roots == {
        *("store", "depalletize", "move", "exchange", "set_aside", "ask_person", "recover"),
        "restart_arm",
        "hand_over",
    }


def test_every_declaration_explains_itself(cell: Repository) -> None:
    """Facts, resources and schemata all have a comment."""
    for part in (cell.facts, cell.resources, cell.schemata):
        assert all(declaration.comment for declaration in part.values())


def test_motions_can_be_probed_and_messages_sent_again(cell: Repository) -> None:
    """A suction stroke is never broken off; what has no probe is idempotent."""
    for action in cell.schemata.values():
        if not isinstance(action, Action):
            continue
        moves = action.name.startswith("kr60_") or action.name == "draw_back"
        assert (action.probe is not None) == moves
        assert action.idempotent != moves
        if moves:
            suction = action.probe == "gripper"
            whole = suction or action.name == "draw_back"
            assert action.cancel is (Cancel.NEVER if whole else Cancel.AT_CHECKPOINT)


def test_putting_down_is_one_change(cell: Repository) -> None:
    """Letting go, standing there and being nowhere are reported together."""
    release = cell.schemata["kr60_release"]
    assert isinstance(release, Action)
    box = Var("Box")
    assert release.sets == (
        FactRef(box, "taken"),
        FactRef(box, "stored"),
        FactRef(Literal("kr60"), "at"),
    )
