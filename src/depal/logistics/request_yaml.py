"""Files of requests as YAML: text, numbers, true, false and null, and nothing that YAML guesses.

The safe loader's own guesses would turn 1:30 into ninety and 010 into eight; here both stay
text, every digit of it, for the field that holds them to judge.
"""

import re
from dataclasses import dataclass

import yaml

from depal.errors import Problem, RequestError
from depal.logistics.findings import Finding, shown
from depal.logistics.json_text import whole_number

_TAG = "tag:yaml.org,2002:"
_WHOLE = re.compile(r"[-+]?(0|[1-9][0-9]*)$")
_FLOAT = re.compile(
    r"([-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?|[-+]?\.inf|\.nan)$"
)


class _Loader(yaml.SafeLoader):
    """The safe loader, which recognises in plain text only what JSON would."""

    yaml_implicit_resolvers = {  # noqa: RUF012 - never changed; the base class declares it
        None: [
            (f"{_TAG}null", re.compile(r"(~|null)?$")),
            (f"{_TAG}bool", re.compile(r"(true|false)$")),
            (f"{_TAG}int", _WHOLE),
            (f"{_TAG}float", _FLOAT),
        ]
    }


@dataclass(frozen=True, slots=True)
class YamlItem:
    """One item of the list.

    Attributes:
        value: what it holds; lists and objects inside of it are kept by their kind alone.
        line: the line on which it begins, from 1.
        lines: the line of each of its keys.
        findings: what YAML allows and the format does not.
    """

    value: object
    line: int
    lines: dict[str, int]
    findings: tuple[Finding, ...] = ()


def items_of_yaml(text: str, source: str) -> list[YamlItem]:
    """The items of the list in a YAML text.

    Args:
        text: the text.
        source: where it comes from, for the error.

    Returns:
        The items in the order of the text.

    Raises:
        RequestError: the text is not YAML, with line and column; or it is no list.
    """
    try:
        root = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        said = [error.context] if (error.problem or "but").startswith("but") else []
        what = ", ".join(str(part) for part in (*said, error.problem) if part)
        problem = Problem(where, f"not YAML: {what}")
        raise RequestError(source, [problem]) from None
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        what = f"{shown(text[error.position : error.position + 1])} is no character for YAML"
        raise RequestError(source, [Problem(f"line {line}", what)]) from None
    except RecursionError:
        problem = Problem("", "lists within lists, too deep to be requests")
        raise RequestError(source, [problem]) from None
    except (ValueError, OverflowError):
        problem = Problem("", "an escape in quotes stands for no character")
        raise RequestError(source, [problem]) from None
    if root is None:
        raise RequestError(source, [Problem("", "is empty", "a list of requests; [] for none")])
    if not isinstance(root, yaml.SequenceNode):
        where = f"line {root.start_mark.line + 1}"
        problem = Problem(where, f"{shown(_value(root))} is not a list", "a list of requests")
        raise RequestError(source, [problem])
    return [_item(node) for node in root.value]


def _item(node: yaml.Node) -> YamlItem:
    line = node.start_mark.line + 1
    if not isinstance(node, yaml.MappingNode):
        return YamlItem(_value(node), line, {})
    value: dict[str, object] = {}
    lines: dict[str, int] = {}
    findings = []
    for key_node, value_node in node.value:
        key = key_node.value if isinstance(key_node, yaml.ScalarNode) else shown(_value(key_node))
        if key in value:
            findings.append(Finding((key,), "the key stands here twice", "every key once"))
        if _foreign(value_node):
            tag = shown(value_node.tag.removeprefix(_TAG))
            findings.append(Finding((key,), f"the tag {tag} has no meaning here"))
        value[key] = _value(value_node)
        lines.setdefault(key, key_node.start_mark.line + 1)
    return YamlItem(value, line, lines, tuple(findings))


def _value(node: yaml.Node) -> object:
    if isinstance(node, yaml.MappingNode):
        return {}
    if isinstance(node, yaml.SequenceNode):
        return []
    return _scalar(node.tag.removeprefix(_TAG), str(node.value))


def _scalar(kind: str, text: str) -> object:
    """A plain value; what a tag calls a number and is none stays text."""
    if kind == "null":
        return None
    if kind == "bool":
        return text == "true"
    if kind == "int" and _WHOLE.fullmatch(text):
        return whole_number(text)
    if kind == "float" and _FLOAT.fullmatch(text):
        return float(text.replace(".inf", "inf").replace(".nan", "nan"))
    return text


def _foreign(node: yaml.Node) -> bool:
    plain = {f"{_TAG}{kind}" for kind in ("null", "bool", "int", "float", "str", "seq", "map")}
    return node.tag not in plain
