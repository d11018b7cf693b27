"""What the language understands, by example."""

import pytest

from depal.executive.conditions import (
    ALWAYS,
    AllOf,
    AnyOf,
    Compare,
    Condition,
    FactRef,
    Holds,
    Lasting,
    Literal,
    Not,
    Var,
)
from depal.executive.language import format_condition, format_repository, parse, parse_term
from depal.executive.schema import Action, Cancel, FactType, Param, Task

A, B, C = (Holds(FactRef(Var("Box"), name)) for name in "abc")
KR60_AT = FactRef(Literal("kr60"), "at")


@pytest.mark.parametrize(
    ("text", "condition"),
    [
        ("true", ALWAYS),
        ("Box.a", A),
        ("not Box.a", Not(A)),
        ("Box.a and Box.b or Box.c", AnyOf((AllOf((A, B)), C))),
        ("Box.a and (Box.b or Box.c)", AllOf((A, AnyOf((B, C))))),
        ("not (Box.a and Box.b)", Not(AllOf((A, B)))),
        ("not Box.a for 2 s", Not(Lasting(A, 2.0))),
        ("(not Box.a) for 2 s", Lasting(Not(A), 2.0)),
        ("Box.a and Box.b for 0.5 s", AllOf((A, Lasting(B, 0.5)))),
        ("(Box.a and Box.b) for 120 s", Lasting(AllOf((A, B)), 120.0)),
        ("kr60.at = Box", Compare(KR60_AT, "=", Var("Box"))),
        ("kr60.at != reader", Compare(KR60_AT, "!=", Literal("reader"))),
        ("kr60.at = Box.target", Compare(KR60_AT, "=", FactRef(Var("Box"), "target"))),
        ("Box.a >= -1.5", Compare(A.fact, ">=", Literal(-1.5))),
    ],
)
def test_a_condition_means_what_it_says(text: str, condition: Condition) -> None:
    """Not binds more than and, and more than or; for binds most; each is written as it is read."""
    assert until(text) == condition
    assert format_condition(condition) == text


@pytest.mark.parametrize(
    ("text", "canonical"),
    [
        ("Box.a ^ ¬Box.b", "Box.a and not Box.b"),
        ("Box.a ∧ ~Box.b", "Box.a and not Box.b"),
        ("Box.a && !Box.b", "Box.a and not Box.b"),
        ("Box.a v Box.b", "Box.a or Box.b"),
        ("Box.a \N{LOGICAL OR} Box.b", "Box.a or Box.b"),
        ("Box.a | Box.b", "Box.a or Box.b"),
        ("((Box.a))", "Box.a"),
        ("Box.a ≤ 3.0", "Box.a <= 3"),
        ("Box.a for 500 ms", "Box.a for 0.5 s"),
        ("Box.a\tfor 2min", "Box.a for 120 s"),
    ],
)
def test_other_ways_to_write_become_one(text: str, canonical: str) -> None:
    """Glyphs, spare parentheses and units are read, and written in one way."""
    assert format_condition(until(text)) == canonical


def until(text: str) -> Condition:
    """A condition, read as the postcondition of an action."""
    return parse(f"action a(Box) until {text}").schemata["a"].until


def test_clauses_stand_in_any_order_and_on_several_lines() -> None:
    """Every clause of an action is read wherever it stands."""
    action = parse(
        "# Lifts the box.\n"
        "action lift(Box, From: place)   # Gently.\n"
        "\tidempotent probe gripper backoff 500 ms retries 3\n"
        "\ttimeout 2 min cancel at_checkpoint\n"
        "    sets Box.a, kr60.at uses kr60, store   # Slowly.\n"
        "    when Box.b until Box.a"
    ).schemata["lift"]
    assert action == Action(
        "lift",
        (Param("Box", "Box"), Param("From", "place")),
        until=A,
        when=B,
        uses=("kr60", "store"),
        sets=(A.fact, KR60_AT),
        cancel=Cancel.AT_CHECKPOINT,
        timeout=120.0,
        retries=3,
        backoff=0.5,
        probe="gripper",
        idempotent=True,
        comment="Lifts the box. Gently. Slowly.",
    )


def test_the_kinds_of_a_fact_are_read() -> None:
    """One kind or several, and a mark where it may be empty."""
    facts = parse(
        "\ufefffact Box.a: flag # first\r\n"
        "# above\n"
        "fact Box.b : place ?  # behind\n"
        "\n# alone\n\n"
        "fact kr60.at : Box | place?\n"
    ).facts
    assert facts["Box.a"].type == FactType(("flag",))
    assert facts["Box.a"].comment == "first"
    assert facts["Box.b"].type == FactType(("place",), optional=True)
    assert facts["Box.b"].comment == "above behind"
    assert facts["kr60.at"].type == FactType(("Box", "place"), optional=True)
    assert facts["kr60.at"].comment == ""


def test_comments_and_clauses_of_steps_are_kept() -> None:
    """A comment inside a task belongs to the whole of it."""
    task = parse("task t(Box) until Box.a\n  - x(Box, b) bias -0.5 when Box.b # why").schemata["t"]
    assert isinstance(task, Task)
    assert task.comment == "why"
    assert task.steps[0].bias == -0.5
    assert task.steps[0].args == (Var("Box"), Literal("b"))


def test_a_term_may_stand_in_a_task_file() -> None:
    """The paper's notation is a declaration like any other."""
    term = "schema(t(Box), ⟨(x(Box), Box.a > 2),\n(y(), true)⟩,\nBox.b)"
    task = parse(f"fact Box.a : number\n# c\n{term}\n").schemata["t"]
    assert isinstance(task, Task)
    assert task.steps == parse_term(term).steps
    assert task.comment == "c"
    assert format_repository(parse(term)) == (
        "task t(Box) until Box.b\n  - x(Box)  when Box.a > 2\n  - y()\n"
    )


def test_the_digest_changes_with_the_meaning_and_not_with_the_spaces() -> None:
    """The digest is that of the canonical text."""
    first = parse("action a(Box) until Box.a")
    assert len(first.digest) == 16
    assert first.digest == parse("action  a( Box )\n  until Box . a\n").digest
    assert first.digest != parse("action a(Box) until Box.b").digest


def test_a_value_that_no_text_gives_is_shown_all_the_same() -> None:
    """A comparison with true is refused when it is read, and can still be printed."""
    assert format_condition(Compare(A.fact, "=", Literal(True))) == "Box.a = true"  # noqa: FBT003
    assert format_condition(Compare(A.fact, "=", Literal(False))) == "Box.a = false"  # noqa: FBT003


def test_an_empty_text_is_an_empty_repository() -> None:
    """Nothing declared is nothing written."""
    assert format_repository(parse("")) == ""
