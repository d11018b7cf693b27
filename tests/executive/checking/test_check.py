"""Planted mistakes, each found by its kind; the shipped tasks have none."""

import time
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import pytest

from depal.executive.checking import Finding, FindingKind, check
from depal.executive.language import parse, read_tasks
from depal.executive.schema import Action

STORE = Path(str(files("depal.cell.tasks") / "store.task"))
CELL = Path(str(files("depal.cell.tasks") / "cell.task"))

SOUND = """
fact Box.taken : flag
fact Box.known : flag
fact Box.weight : number
fact Box.target : place?
fact arm.at : Box | place ?
resource arm capacity 1

task fetch(Box) until Box.taken
  - reach(Box)
  - grasp(Box)  when arm.at = Box
action reach(Box) until arm.at = Box uses arm sets arm.at
action grasp(Box) until Box.taken uses arm sets Box.taken
"""


def found(text: str, kind: FindingKind) -> list[Finding]:
    """The findings of one kind in a text."""
    return [one for one in check(parse(text, "test.task")) if one.kind is kind]


def only(text: str, kind: FindingKind) -> Finding:
    """The one finding of a kind, which must be the only serious one."""
    serious = [one for one in check(parse(text, "test.task")) if one.serious]
    findings = found(text, kind)
    assert len(findings) == 1
    if findings[0].serious:
        assert serious == findings
    return findings[0]


def test_a_sound_repository_has_no_finding() -> None:
    """The ground on which the mistakes below are planted."""
    assert check(parse(SOUND, "test.task")) == []


def test_the_papers_store_has_no_mistake() -> None:
    """And its contentions of Section II-B are remarked upon."""
    findings = check(read_tasks(STORE))
    assert not any(one.serious for one in findings)
    contentions = [one.what for one in findings if one.kind is FindingKind.CONTENTION]
    assert any("kr60_show(Box) and kr60_carry(Box)" in what for what in contentions)


def test_the_shipped_tasks_have_no_mistake() -> None:
    """Both files together."""
    assert not any(one.serious for one in check(read_tasks([STORE, CELL])))


def test_an_unknown_subtask_is_found_with_the_one_that_was_meant() -> None:
    """A slip of the pen."""
    finding = only(SOUND.replace("- grasp(Box)", "- graps(Box)"), FindingKind.UNKNOWN_SUBTASK)
    assert finding.where == "fetch(Box), step 2 graps(Box)"
    assert str(finding) == (
        "fetch(Box), step 2 graps(Box): unknown subtask 'graps'; did you mean 'grasp'?"
    )


def test_a_wrong_number_of_arguments_is_found() -> None:
    """One too many."""
    finding = only(SOUND.replace("- reach(Box)", "- reach(Box, Box)"), FindingKind.WRONG_ARITY)
    assert finding.what == "reach(Box) takes 1 argument, 2 given"


def test_an_argument_of_the_wrong_sort_is_found() -> None:
    """A place where a box belongs."""
    text = SOUND.replace("task fetch(Box)", "task fetch(Box, From: place)").replace(
        "- reach(Box)", "- reach(From)"
    )
    finding = only(text, FindingKind.WRONG_SORT)
    assert finding.what == "From, a place, is given where reach(Box) takes a Box"
    assert finding.exists == "there is: Box"


def test_an_unbound_variable_is_found() -> None:
    """As an argument, and as the subject of a fact: a sort is no thing."""
    finding = only(SOUND.replace("- reach(Box)", "- reach(Bax)"), FindingKind.UNBOUND_VARIABLE)
    assert finding.what == "'Bax' is no parameter of fetch(Box)"
    assert finding.exists == "there is: Box"
    text = SOUND.replace(
        "action reach(Box) until arm.at = Box", "action reach(B: Box) until Box.known"
    )
    finding = only(text, FindingKind.UNBOUND_VARIABLE)
    assert finding.where == "reach(B), until"
    assert finding.what == "'Box' is no parameter of reach(B)"


def test_an_undeclared_fact_is_found() -> None:
    """In a condition and behind sets."""
    text = SOUND.replace("uses arm sets Box.taken", "uses arm sets Box.taken, Box.tken")
    finding = only(text, FindingKind.UNDECLARED_FACT)
    assert str(finding) == (
        "grasp(Box), sets: undeclared fact 'Box.tken'; did you mean 'Box.taken'?"
    )
    text = SOUND.replace("when arm.at = Box", "when arm.att = Box")
    assert only(text, FindingKind.UNDECLARED_FACT).exists == "did you mean 'arm.at'?"


@pytest.mark.parametrize(
    ("condition", "said"),
    [
        ("Box.weight = reader", "Box.weight holds a number and is compared with reader"),
        ("Box.taken = reader", "Box.taken holds a flag and is compared with reader"),
        ("Box.target = Box", "Box.target holds a place and is compared with Box, a Box"),
        ("arm.at = 3", "arm.at holds a Box or place and is compared with 3"),
        ("Box.taken = Box.weight", "Box.taken holds a flag and is compared with Box.weight"),
        ("arm.at < Box", "arm.at holds a Box or place, which has no order"),
    ],
)
def test_a_comparison_with_another_kind_of_value_is_found(condition: str, said: str) -> None:
    """Flags, numbers, names and sorts are kept apart."""
    text = SOUND.replace("when arm.at = Box", f"when {condition}")
    assert only(text, FindingKind.WRONG_VALUE).what.startswith(said)


def test_undeclared_resources_are_found() -> None:
    """Behind uses and behind keeps."""
    text = SOUND.replace("resource arm capacity 1", "resource armm capacity 1")
    assert [one.where for one in found(text, FindingKind.UNDECLARED_RESOURCE)] == [
        "reach(Box), uses",
        "grasp(Box), uses",
    ]
    text = SOUND.replace(
        "task fetch(Box) until Box.taken", "task fetch(Box) until Box.taken keeps arms"
    )
    assert only(text, FindingKind.UNDECLARED_RESOURCE).exists == "did you mean 'arm'?"


def test_an_action_that_uses_more_than_there_is_is_found() -> None:
    """Two arms where there is one; the language has no way to write it, a program has."""
    repository = parse(SOUND, "test.task")
    grasp = repository.schemata["grasp"]
    assert isinstance(grasp, Action)
    greedy = dict(repository.schemata) | {"grasp": replace(grasp, uses=("arm", "arm"))}
    findings = check(replace(repository, schemata=greedy))
    assert [one.kind for one in findings if one.serious] == [FindingKind.OVER_CAPACITY]
    assert findings[0].what == "uses arm 2 times; its capacity is 1"


def test_an_action_that_sets_nothing_of_its_until_is_found() -> None:
    """It would fail for ever."""
    text = SOUND.replace("uses arm sets Box.taken", "uses arm sets Box.known")
    findings = found(text, FindingKind.POWERLESS)
    assert [one.what for one in findings] == ["sets nothing that its until depends on: Box.taken"]


def test_an_action_whose_values_cannot_make_its_until_true_is_found() -> None:
    """It would have to be in two states at once."""
    text = SOUND.replace(
        "action grasp(Box) until Box.taken",
        "action grasp(Box) until Box.taken and not Box.taken and Box.known",
    )
    assert found(text, FindingKind.POWERLESS)[0].what.startswith("whatever it sets")


def test_a_branch_that_contradicts_the_postcondition_above_is_found() -> None:
    """It waits for the end of what it is part of."""
    text = SOUND.replace("when arm.at = Box", "when arm.at = Box and Box.taken")
    finding = only(text, FindingKind.NEVER_ENABLED)
    assert finding.where == "fetch(Box), step 2 grasp(Box)"
    assert "'not Box.taken'" in finding.what


def test_a_branch_that_needs_two_places_at_once_is_found() -> None:
    """A single-valued fact has one value; only the topmost node is named."""
    text = SOUND.replace("when arm.at = Box", "when arm.at = left and arm.at = right")
    assert only(text, FindingKind.NEVER_ENABLED).where == "fetch(Box), step 2 grasp(Box)"


def test_numbers_are_compared_exactly() -> None:
    """Between two neighbouring limits there is room, below both there is none."""
    possible = SOUND.replace("when arm.at = Box", "when Box.weight > 2 and Box.weight < 3")
    assert not found(possible, FindingKind.NEVER_ENABLED)
    impossible = SOUND.replace("when arm.at = Box", "when Box.weight > 3 and Box.weight < 2")
    assert found(impossible, FindingKind.NEVER_ENABLED)


def test_a_node_that_no_run_reaches_is_found() -> None:
    """Its conditions agree with one another, but no action leads there."""
    text = SOUND.replace("when arm.at = Box", "when arm.at = window")
    finding = only(text, FindingKind.UNREACHABLE)
    assert finding.where == "fetch(Box), step 2 grasp(Box)"


def test_endless_recursion_is_found() -> None:
    """Directly and through others."""
    text = (
        SOUND + "task a(Box) until Box.known\n  - b(Box)\ntask b(Box) until Box.known\n  - a(Box)\n"
    )
    assert only(text, FindingKind.ENDLESS).what == "a and b call one another without end"
    text = SOUND + "task a(Box) until Box.known\n  - a(Box)\n"
    assert only(text, FindingKind.ENDLESS).what == "a calls itself without end"


def test_an_unused_action_is_remarked_upon() -> None:
    """It is no mistake."""
    text = SOUND + "action weigh(Box) until Box.known sets Box.known\n"
    finding = only(text, FindingKind.UNUSED_ACTION)
    assert not finding.serious
    assert finding.where == "weigh(Box)"


def test_tasks_that_nobody_calls_are_remarked_upon_where_there_are_several() -> None:
    """A single one is what the file is for."""
    text = SOUND + "task point(Box) until arm.at = Box\n  - reach(Box)\n"
    assert [one.where for one in found(text, FindingKind.UNCALLED_TASK)] == [
        "fetch(Box)",
        "point(Box)",
    ]


@pytest.mark.parametrize(
    ("bias", "winner"),
    [("", "reach(Box) wins, the earlier step"), (" bias 0.5", "grasp(Box) wins, the greater bias")],
)
def test_contention_says_who_wins(bias: str, winner: str) -> None:
    """The greater bias, else the earlier step."""
    text = SOUND.replace("when arm.at = Box", f"when Box.known{bias}")
    finding = only(text, FindingKind.CONTENTION)
    assert finding.what == f"reach(Box) and grasp(Box) contend for arm: {winner}"


def test_a_change_that_several_branches_read_is_remarked_upon() -> None:
    """Were it split, the first half would start something."""
    shared = [one for one in check(read_tasks(STORE)) if one.kind is FindingKind.SHARED_CHANGE]
    assert [one.where for one in shared] == ["kr60_grasp(Box)", "kr60_release(Box)"]
    assert all("must arrive as one change" in one.what for one in shared)


def test_an_unbound_primitive_is_found_where_the_primitives_are_known() -> None:
    """Not otherwise."""
    repository = parse(SOUND, "test.task")
    assert check(repository, primitives=["reach", "grasp"]) == []
    finding = check(repository, primitives=["reach", "grab"])[0]
    assert finding.kind is FindingKind.UNBOUND_PRIMITIVE
    assert finding.serious


def test_everything_is_found_at_once_and_only_once() -> None:
    """Mistakes before remarks."""
    text = SOUND.replace("- reach(Box)", "- raech(Box)").replace("arm.at = Box\n", "arm.on\n", 1)
    text += "action weigh(Box) until Box.known sets Box.known\n"
    findings = check(parse(text, "test.task"))
    kinds = [one.kind for one in findings]
    assert {FindingKind.UNKNOWN_SUBTASK, FindingKind.UNDECLARED_FACT} <= set(kinds)
    assert len(findings) == len(set(findings))
    assert [one.serious for one in findings] == sorted(one.serious for one in findings)[::-1]


@pytest.mark.slow
def test_the_store_is_checked_within_its_time() -> None:
    """100 ms, with room for a slow machine."""
    repository = read_tasks(STORE)
    start = time.perf_counter()
    check(repository)
    assert time.perf_counter() - start < 0.3
