"""Every mistake in a task file is a sentence with its place and a way out."""

from pathlib import Path

import pytest

from depal.errors import TaskError
from depal.executive.language import parse, parse_term, read_tasks

MISTAKES = [
    tuple(case.strip("\n").split("\n=> "))
    for case in (Path(__file__).parent / "mistakes.txt").read_text("utf-8").split("\n\n")
]
"""Pairs of a text and the sentence about it."""

TWICE = "schema(t(Box, Box), <(x(Box), true)>, Box.a)"


@pytest.mark.parametrize(("text", "sentence"), MISTAKES, ids=[sentence for _, sentence in MISTAKES])
def test_a_mistake_is_one_sentence(text: str, sentence: str) -> None:
    """One planted mistake is one problem; mistakes.txt pins its sentence."""
    with pytest.raises(TaskError) as caught:
        parse(text, "cell.task")
    assert [str(problem) for problem in caught.value.problems] == [sentence]
    assert str(caught.value) == f"cell.task: {sentence}"


def test_all_mistakes_are_found_at_once() -> None:
    """Reading goes on at the next declaration, and at the next step."""
    text = (
        "fact a\n\ntask t(Box) until Box.a\n  - x Box\n  - y(Box)\n  - z(\nresource r capacity 0\n"
    )
    with pytest.raises(TaskError) as caught:
        parse(text)
    places = [problem.where for problem in caught.value.problems]
    assert places == [
        "line 1, column 7",
        "line 4, column 7",
        "line 6, column 7",
        "line 7, column 21",
    ]
    assert str(caught.value).startswith("tasks: 4 problems\n  line 1, column 7: ")


def test_undeclared_names_are_no_mistake_of_the_text() -> None:
    """Facts, subtasks and resources that nothing declares are the checker's to find."""
    repository = parse("task t(Box) until Nobody.knows keeps nothing\n  - nowhere(Box, ghost)")
    assert set(repository.schemata) == {"t"}


@pytest.mark.parametrize(
    "text", ["", "  \n", "# only a comment\n", "store(Box)", "schema(t()) x", TWICE]
)
def test_what_is_no_term_is_refused(text: str) -> None:
    """A term begins with schema and has three parts."""
    with pytest.raises(TaskError, match=r"^term: "):
        parse_term(text)


def test_files_make_one_repository_and_share_their_names(tmp_path: Path) -> None:
    """A second declaration in another file is found, and both places are named."""
    first, second = tmp_path / "a.task", tmp_path / "b.task"
    first.write_text("fact Box.a : flag\n", "utf-8")
    second.write_text("fact Box.b : flag\n", "utf-8")
    assert set(read_tasks([first, second]).facts) == {"Box.a", "Box.b"}
    second.write_text("\nfact Box.a : text\n", "utf-8")
    with pytest.raises(TaskError) as caught:
        read_tasks([first, second])
    assert str(caught.value) == (
        f"{second}, line 2, column 1: fact 'Box.a' is declared twice, "
        f"first at line 1, column 1 of {first}; expected it once"
    )


def test_a_missing_file_names_the_one_that_is_there(tmp_path: Path) -> None:
    """A slip in the name of a file is answered with the right one."""
    (tmp_path / "store.task").write_text("", "utf-8")
    with pytest.raises(TaskError, match=r"no such file; did you mean 'store\.task'"):
        read_tasks(tmp_path / "stor.task")
    with pytest.raises(TaskError, match=r"is a directory; expected a file; there is: store\.task"):
        read_tasks(tmp_path)
    with pytest.raises(TaskError, match=r"no such file; there is no folder"):
        read_tasks(tmp_path / "nowhere" / "store.task")


def test_a_folder_without_task_files_says_so(tmp_path: Path) -> None:
    """There is nothing to choose from."""
    with pytest.raises(TaskError, match=r"no such file; the folder has no \.task file"):
        read_tasks(tmp_path / "store.task")


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"# ok\n# \xff\n", "line 2: byte 0xff is not UTF-8; expected a text file in UTF-8"),
        (b"#" * (1024 * 1024 + 1), "is larger than 1 MiB; expected a smaller file"),
    ],
)
def test_a_file_that_is_no_text_is_refused(tmp_path: Path, content: bytes, sentence: str) -> None:
    """Only text, and not too much of it."""
    path = tmp_path / "x.task"
    path.write_bytes(content)
    with pytest.raises(TaskError) as caught:
        read_tasks(path)
    assert str(caught.value) == f"{path}: {sentence}"


def test_no_file_and_an_impossible_name_are_refused(tmp_path: Path) -> None:
    """An empty list and a name with a null byte are errors of the same class."""
    with pytest.raises(TaskError, match="no task file was given; expected at least one"):
        read_tasks([])
    with pytest.raises(TaskError, match="cannot be read"):
        read_tasks(tmp_path / "a\0b.task")
