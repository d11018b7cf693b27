"""Cells from files, from texts and by name."""

import functools
from importlib import resources
from pathlib import Path

from pydantic import ValidationError

from depal.cell.files.cell_model import CellEntry
from depal.cell.files.contradictions import contradictions
from depal.cell.files.yaml_tree import YamlTree, tree_of_yaml
from depal.domain import CellLayout
from depal.errors import CellError, Problem
from depal.logistics.expectations import Expectations
from depal.logistics.findings import Finding, choices, place, shown
from depal.logistics.sentences import findings_of
from depal.logistics.source_text import read_text

ENDINGS = (".yaml", ".yml")
"""How cell files end."""

LIMIT = 1
"""No cell file is larger [MiB]."""

SHIPPED = ("default", "roll_containers", "small_trolleys")
"""The cells that ship with the package; the first is the paper's."""


def read_cell(path: Path) -> CellLayout:
    """The cell of a file.

    Args:
        path: a YAML file.

    Returns:
        The cell, every value checked; whether it can do its work is another question.

    Raises:
        CellError: the file cannot be used; with everything that is wrong with it.
    """
    return cell_of_yaml(read_text(path, CellError, ENDINGS, LIMIT), str(path))


def shipped_cell(name: str = SHIPPED[0]) -> CellLayout:
    """A cell that ships with the package.

    Args:
        name: one of `SHIPPED`.

    Raises:
        CellError: no shipped cell has this name.
    """
    return cell_of_yaml(shipped_text(name), f"shipped cell {name}")


def find_cell(reference: str) -> CellLayout:
    """A cell by its file or its name.

    Args:
        reference: a file, or the name of a shipped cell; a file of exactly this name wins.

    Raises:
        CellError: nothing is meant by this, or the file is unusable.
    """
    path = Path(reference)
    if _is_file(path):
        return read_cell(path)
    if reference in SHIPPED:
        return shipped_cell(reference)
    if "/" in reference or path.suffix.lower() in ENDINGS:
        return read_cell(path)
    what = f"neither a file nor a shipped cell is called {shown(reference)}"
    exists = choices(reference[:100], SHIPPED)
    raise CellError("", [Problem("", what, "FILE or a shipped cell's name", exists)])


def shipped_text(name: str) -> str:
    """The text of a shipped cell's file, to begin one's own from.

    Raises:
        CellError: no shipped cell has this name.
    """
    if name not in SHIPPED:
        what = f"no shipped cell is called {shown(name)}"
        raise CellError("", [Problem("", what, exists=choices(name[:100], SHIPPED))])
    return (resources.files("depal.cell") / "cells" / f"{name}.yaml").read_text("utf-8")


def cell_of_yaml(text: str, source: str) -> CellLayout:
    """The cell of a text.

    Args:
        text: YAML.
        source: where it comes from, for the error.

    Raises:
        CellError: with everything that is wrong with it, each with its line.
    """
    tree = tree_of_yaml(text, source)
    findings = list(tree.findings)
    known = {finding.loc for finding in findings}
    try:
        entry = CellEntry.model_validate(tree.value)
    except ValidationError as error:
        shape = findings_of(error, _expectations())
        findings += [finding for finding in shape if finding.loc not in known]
        raise _error(source, tree, findings) from None
    findings += contradictions(entry)
    if findings:
        raise _error(source, tree, findings)
    return entry.as_layout()


def _error(source: str, tree: YamlTree, findings: list[Finding]) -> CellError:
    order = _expectations().order
    ordered = sorted(findings, key=lambda finding: order(finding.loc))
    return CellError(source, [_placed(finding, tree) for finding in ordered])


def _placed(finding: Finding, tree: YamlTree) -> Problem:
    line = f"line {tree.line(finding.loc)}"
    where = f"{line}, {place(finding.loc)}" if finding.loc else line
    twin = f"line {tree.line(finding.twin)}" if finding.twin else ""
    return finding.at(where, twin)


@functools.cache
def _expectations() -> Expectations:
    return Expectations(CellEntry.model_json_schema())


def _is_file(path: Path) -> bool:
    """Whether something that can be read has this name."""
    try:
        return path.exists() and not path.is_dir()
    except (OSError, ValueError):
        return False
