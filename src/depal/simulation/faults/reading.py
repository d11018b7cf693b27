"""Files of faults: read once, checked as a whole."""

import functools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml
from pydantic import ValidationError

from depal.errors import FaultError, Problem, did_you_mean
from depal.logistics.expectations import Expectations
from depal.logistics.findings import Finding, Loc, place, shown
from depal.logistics.sentences import findings_of
from depal.logistics.source_text import read_text
from depal.logistics.yaml_text import TAG, composed, foreign, scalar
from depal.simulation.faults.catalogue import CATALOGUE, Phase
from depal.simulation.faults.fault_model import FaultEntry
from depal.simulation.faults.plan import FaultPlan

ENDINGS = (".yaml", ".yml")
LIMIT = 1
"""No file of faults is larger [MiB]."""

DEEPEST = 3
"""A fault holds an object, and that holds plain values."""


def read_faults(path: Path) -> FaultPlan:
    """All faults of a file.

    Args:
        path: a YAML file with a list of faults.

    Raises:
        FaultError: the file cannot be used; with everything that is wrong with it.
    """
    source = str(path)
    root = composed(read_text(path, FaultError, ENDINGS, LIMIT), source, FaultError, "faults")
    if root is None:
        raise FaultError(source, [Problem("", "is empty", "a list of faults; [] for none")])
    if not isinstance(root, yaml.SequenceNode):
        problem = Problem(f"line {_line(root)}", "is not a list", "a list of faults")
        raise FaultError(source, [problem])
    faults, problems = [], []
    for index, node in enumerate(root.value):
        lines: dict[Loc, int] = {}
        findings: list[Finding] = []
        value = _value(node, (), lines, findings)
        entry = _checked(value, findings)
        problems += [finding.at(_where(index, lines, finding.loc)) for finding in findings]
        if entry is not None and not findings:
            faults.append(entry.as_fault())
    if problems:
        raise FaultError(source, problems)
    return FaultPlan(tuple(faults))


def faults_schema() -> dict[str, Any]:
    """The JSON Schema (draft 2020-12) of a file of faults, read as YAML."""
    entry = FaultEntry.model_json_schema()
    parts = entry.pop("$defs")
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Faults file",
        "description": "A list of faults that strike a simulated cell. Times since the start.",
        "type": "array",
        "items": {"$ref": "#/$defs/FaultEntry"},
        "$defs": {**parts, "FaultEntry": entry},
    }


def _checked(value: object, findings: list[Finding]) -> FaultEntry | None:
    """The entry, where its shape is right; what is wrong is added to the findings."""
    known = {finding.loc for finding in findings}
    entry = None
    try:
        entry = FaultEntry.model_validate(value)
    except ValidationError as error:
        shape = findings_of(error, _expectations())
        findings += [finding for finding in shape if finding.loc not in known]
    if isinstance(value, dict):
        findings += _unknown(value)
    findings.sort(key=lambda finding: _expectations().order(finding.loc))
    return entry


def _unknown(value: dict[str, object]) -> Iterator[Finding]:
    """Names that mean nothing, and conditions that never hold."""
    name, when = value.get("fault"), value.get("when")
    entry = CATALOGUE.get(name) if isinstance(name, str) else None
    if isinstance(name, str) and entry is None:
        exists = did_you_mean(name, CATALOGUE)
        yield Finding(("fault",), f"unknown fault {shown(name)}", exists=exists)
    if not isinstance(when, dict):
        return
    phase, phases = when.get("phase"), [each.value for each in Phase]
    if isinstance(phase, str) and phase not in phases:
        exists = did_you_mean(phase, phases)
        yield Finding(("when", "phase"), f"unknown phase {shown(phase)}", exists=exists)
    elif isinstance(phase, str) and entry is not None and Phase(phase) not in entry.phases:
        expected = " or ".join(each.value for each in entry.phases)
        yield Finding(("when", "phase"), f"{entry.id} cannot strike in phase {phase}", expected)
    if entry is not None and not entry.about_box and "box" in when:
        yield Finding(("when", "box"), f"{entry.id} strikes no box", "no box")


@functools.cache
def _expectations() -> Expectations:
    return Expectations(FaultEntry.model_json_schema())


def _value(node: yaml.Node, loc: Loc, lines: dict[Loc, int], findings: list[Finding]) -> object:
    """What a node holds; the lines of its keys and what the format does not know are noted."""
    lines[loc] = _line(node)
    if foreign(node):
        tag = shown(node.tag.removeprefix(TAG))
        findings.append(Finding(loc, f"the tag {tag} has no meaning here"))
    if isinstance(node, yaml.ScalarNode):
        return scalar(node)
    if not isinstance(node, yaml.MappingNode) or len(loc) >= DEEPEST:
        return {} if isinstance(node, yaml.MappingNode) else []
    value: dict[str, object] = {}
    for key_node, value_node in node.value:
        key = key_node.value if isinstance(key_node, yaml.ScalarNode) else "?"
        if key in value:
            findings.append(Finding((*loc, key), "the key stands here twice", "every key once"))
        value[key] = _value(value_node, (*loc, key), lines, findings)
    return value


def _line(node: yaml.Node) -> int:
    return int(node.start_mark.line) + 1


def _where(index: int, lines: dict[Loc, int], loc: Loc) -> str:
    line = next(lines[loc[:depth]] for depth in range(len(loc), -1, -1) if loc[:depth] in lines)
    return f"line {line}, {place((index, *loc))}"
