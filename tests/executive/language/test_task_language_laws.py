"""The laws of the language: text and repository say the same, and nothing else is ever raised."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import TaskError
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
    Operand,
    Var,
)
from depal.executive.language import (
    digest_of,
    format_condition,
    format_repository,
    format_schema,
    parse,
    parse_term,
)
from depal.executive.language.words import KEYWORDS
from depal.executive.schema import (
    Action,
    Cancel,
    FactDeclaration,
    FactType,
    Limit,
    Param,
    Repository,
    Resource,
    Schema,
    Step,
    Task,
)
from depal.executive.units import UNITS

VARIABLES = ("Box", "From", "To")
NAMES = st.one_of(
    st.sampled_from(["kr60", "reader", "s", "v", "m", "trolley_1", "_", "a_name_that_is_" * 4]),
    st.from_regex(r"[a-z_][a-z0-9_]{0,12}", fullmatch=True).filter(lambda n: n not in KEYWORDS),
)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
DURATIONS = st.floats(min_value=0, exclude_min=True, allow_infinity=False)
COMMENTS = st.lists(
    st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=90), max_size=4
).map(lambda words: " ".join(" ".join(words).split()))


def operands(variables: tuple[str, ...]) -> st.SearchStrategy[Operand]:
    """Parameters and names of things."""
    things = NAMES.map(Literal)
    return st.one_of(st.sampled_from(variables).map(Var), things) if variables else things


def fact_refs(variables: tuple[str, ...]) -> st.SearchStrategy[FactRef]:
    """Facts of parameters and of things."""
    return st.builds(FactRef, operands(variables), NAMES)


def conditions(variables: tuple[str, ...]) -> st.SearchStrategy[Condition]:
    """Conditions nested in every way that has a meaning."""
    facts = fact_refs(variables)
    right = st.one_of(operands(variables), NUMBERS.map(Literal), facts)
    compared = st.builds(Compare, facts, st.sampled_from(["=", "!=", "<", "<=", ">", ">="]), right)
    atoms = st.one_of(st.just(ALWAYS), facts.map(Holds), compared)

    def deeper(part: st.SearchStrategy[Condition]) -> st.SearchStrategy[Condition]:
        parts = st.lists(part, min_size=2, max_size=4).map(tuple)
        return st.one_of(
            part.map(Not), parts.map(AllOf), parts.map(AnyOf), st.builds(Lasting, part, DURATIONS)
        )

    return st.recursive(atoms, deeper, max_leaves=8)


@st.composite
def tasks(draw: st.DrawFn) -> Task:
    """Abstract schemata."""
    params, variables = draw(parameters())
    when = conditions(variables)
    args = st.lists(operands(variables), max_size=3).map(tuple)
    steps = st.lists(st.builds(Step, NAMES, args, when, NUMBERS), min_size=1, max_size=4)
    keeps = st.lists(NAMES, unique=True, max_size=3)
    return Task(
        draw(NAMES),
        params,
        tuple(draw(steps)),
        draw(when),
        draw(when),
        tuple(draw(keeps)),
        draw(COMMENTS),
        draw(when),
        draw(limits(variables)),
        draw(zones(variables)),
    )


def limits(variables: tuple[str, ...]) -> st.SearchStrategy[tuple[Limit, ...]]:
    """Numbers with their units, and facts."""
    units, sides = st.sampled_from(sorted(UNITS)), st.booleans()
    numbers = st.builds(Limit, NAMES, DURATIONS, units, sides)
    told = st.builds(Limit, NAMES, fact_refs(variables), st.just(""), sides)
    return st.lists(numbers | told, unique=True, max_size=3).map(tuple)


def zones(variables: tuple[str, ...]) -> st.SearchStrategy[tuple[str | FactRef, ...]]:
    """Names, and facts that hold one."""
    return st.lists(NAMES | fact_refs(variables), unique=True, max_size=3).map(tuple)


@st.composite
def parameters(draw: st.DrawFn) -> tuple[tuple[Param, ...], tuple[str, ...]]:
    """Parameters, of their own sort or of another, and their names."""
    names = draw(st.lists(st.sampled_from(VARIABLES), unique=True))
    sorts = [draw(st.sampled_from([name, "place", "Pallet"])) for name in names]
    return tuple(map(Param, names, sorts)), tuple(names)


@st.composite
def actions(draw: st.DrawFn) -> Action:
    """Concrete schemata."""
    params, variables = draw(parameters())
    return Action(
        draw(NAMES),
        params,
        until=draw(conditions(variables)),
        when=draw(conditions(variables)),
        uses=tuple(draw(st.lists(NAMES, unique=True, max_size=6))),
        sets=tuple(draw(st.lists(fact_refs(variables), unique=True, max_size=6))),
        cancel=draw(st.sampled_from(Cancel)),
        timeout=draw(st.none() | DURATIONS),
        retries=draw(st.integers(0, 1_000_000)),
        backoff=draw(st.just(0.0) | DURATIONS),
        probe=draw(st.none() | NAMES),
        idempotent=draw(st.booleans()),
        comment=draw(COMMENTS),
        within=draw(conditions(variables)),
        limits=draw(limits(variables)),
        avoids=draw(zones(variables)),
    )


@st.composite
def facts(draw: st.DrawFn) -> FactDeclaration:
    """Declarations of facts."""
    kinds = ["flag", "number", "text", "place", "Box", "Pallet"]
    chosen = tuple(draw(st.lists(st.sampled_from(kinds), unique=True, min_size=1)))
    optional = chosen != ("flag",) and draw(st.booleans())
    subject = draw(NAMES | st.sampled_from(VARIABLES))
    return FactDeclaration(subject, draw(NAMES), FactType(chosen, optional), draw(COMMENTS))


RESOURCES = st.builds(Resource, NAMES, st.integers(1, 1_000_000), COMMENTS)


@st.composite
def repositories(draw: st.DrawFn) -> Repository:
    """Everything that a task file can say."""
    declared = draw(st.lists(facts(), max_size=4))
    resources = draw(st.lists(RESOURCES, max_size=3))
    schemata: list[Schema] = draw(st.lists(tasks() | actions(), max_size=3))
    return Repository(
        {fact.name: fact for fact in declared},
        {resource.name: resource for resource in resources},
        {schema.name: schema for schema in schemata},
    )


@pytest.mark.slow
@given(repositories())
def test_what_is_written_is_read_back(repository: Repository) -> None:
    """Reading the canonical text gives the same repository, in the same order."""
    again = parse(format_repository(repository))
    assert again == repository
    assert list(again.facts) == list(repository.facts)
    assert list(again.schemata) == list(repository.schemata)


@pytest.mark.slow
@given(repositories())
def test_canonical_text_stays_as_it_is(repository: Repository) -> None:
    """Formatting twice is formatting once, and the digest is that of the text."""
    text = format_repository(repository)
    again = parse(text)
    assert format_repository(again) == text
    assert again.digest == digest_of(repository)


@given(conditions(VARIABLES))
def test_parentheses_are_as_few_as_the_nesting_allows(condition: Condition) -> None:
    """Whichever pair of parentheses is left out, something else is said, or nothing."""
    text = format_condition(condition)
    assert condition_of(text) == condition
    for opened in (index for index, sign in enumerate(text) if sign == "("):
        depth, closed = 1, opened
        while depth:
            closed += 1
            depth += {"(": 1, ")": -1}.get(text[closed], 0)
        fewer = text[:opened] + text[opened + 1 : closed] + text[closed + 1 :]
        try:
            assert condition_of(fewer) != condition
        except TaskError:
            continue


def condition_of(text: str) -> Condition:
    """A condition, read as the postcondition of an action."""
    schema = parse(f"action a(Box, From: place, To: place) until {text}").schemata["a"]
    return schema.until


@pytest.mark.slow
@given(tasks() | actions())
def test_a_schema_is_written_as_in_its_repository(schema: Schema) -> None:
    """One schema alone and a repository of it have the same text."""
    alone = format_repository(Repository({}, {}, {schema.name: schema}))
    assert format_schema(schema) + "\n" == alone


SHORT = st.sampled_from(["kr60", "reader", "taken", "at", "stored"])


@given(st.lists(st.lists(SHORT, min_size=1, max_size=30), min_size=1, max_size=12))
def test_lines_have_at_most_a_hundred_columns(names: list[list[str]]) -> None:
    """Long conditions and lists are broken, and a line that goes on is indented."""
    fact = FactRef(Literal("Box"), "taken")
    row = tuple(
        AnyOf((Holds(fact), *(Compare(fact, "<", Literal(-1.5)) for _ in n))) for n in names
    )
    task = Task(
        "t",
        (),
        tuple(Step(n[0], tuple(map(Literal, n)), row[0]) for n in names),
        AllOf((*row, Holds(fact))),
        comment=" ".join(name for n in names for name in n),
    )
    repository = Repository({}, {}, {"t": task})
    text = format_repository(repository)
    assert max(map(len, text.splitlines())) <= 100
    assert parse(text) == repository


WORDS = st.sampled_from(
    [
        *sorted(KEYWORDS),
        *("Box", "kr60", "v", "s", "5", "1e999", "m/s", "kg"),
        *"(),:.-=<>|?^¬⟨⟩§é\t\0\n",
        *("\n  ", "# x\n", "\ntask t(Box) until Box.a\n  - x(Box)"),
    ]
)


TEXTS = st.text() | st.lists(WORDS, max_size=40).map(" ".join)


@given(TEXTS)
def test_arbitrary_text_raises_nothing_but_a_task_error(text: str) -> None:
    """Whatever is given is read or refused, and what is read can be written."""
    try:
        repository = parse(text)
    except TaskError:
        return
    assert parse(format_repository(repository)) == repository


@given(TEXTS.map(lambda text: f"schema({text}"))
def test_an_arbitrary_term_raises_nothing_but_a_task_error(text: str) -> None:
    """The same for the paper's notation."""
    with contextlib.suppress(TaskError):
        parse_term(text)


@pytest.mark.parametrize("piece", ["(", "not ", "¬"])
def test_deep_nesting_is_refused_and_not_recursed_into(piece: str) -> None:
    """A hundred thousand negations are one problem."""
    with pytest.raises(TaskError, match="nested too deep; expected at most 50 of them"):
        parse(f"action a(Box) until {piece * 100_000}")
