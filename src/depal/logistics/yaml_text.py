"""YAML with text, numbers, true, false and null, and nothing that YAML guesses.

The safe loader's own guesses would turn 1:30 into ninety and 010 into eight; here both stay
text, every digit of it, for the field that holds them to judge.
"""

import re

import yaml

from depal.errors import InputError, Problem
from depal.logistics.findings import shown
from depal.logistics.json_text import whole_number

TAG = "tag:yaml.org,2002:"
"""What YAML's own tags begin with."""

_WHOLE = re.compile(r"[-+]?(0|[1-9][0-9]*)$")
_FLOAT = re.compile(
    r"([-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?|[-+]?\.inf|\.nan)$"
)


class _Loader(yaml.SafeLoader):
    """The safe loader, which recognises in plain text only what JSON would."""

    yaml_implicit_resolvers = {  # noqa: RUF012 - never changed; the base class declares it
        None: [
            (f"{TAG}null", re.compile(r"(~|null)?$")),
            (f"{TAG}bool", re.compile(r"(true|false)$")),
            (f"{TAG}int", _WHOLE),
            (f"{TAG}float", _FLOAT),
        ]
    }


def composed(text: str, source: str, kind: type[InputError], things: str) -> yaml.Node | None:
    """The nodes of a YAML text, which know their lines.

    Args:
        text: the text.
        source: where it comes from, for the error.
        kind: the class of the error.
        things: what the text should hold, as in "requests".

    Returns:
        The root; None where the text is empty.

    Raises:
        InputError: of the given kind: the text is not YAML; with line and column.
    """
    try:
        root: yaml.Node | None = yaml.compose(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        said = [error.context] if (error.problem or "but").startswith("but") else []
        what = ", ".join(str(part) for part in (*said, error.problem) if part)
        raise kind(source, [Problem(where, f"not YAML: {what}")]) from None
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        what = f"{shown(text[error.position : error.position + 1])} is no character for YAML"
        raise kind(source, [Problem(f"line {line}", what)]) from None
    except RecursionError:
        problem = Problem("", f"lists within lists, too deep to be {things}")
        raise kind(source, [problem]) from None
    except (ValueError, OverflowError):
        problem = Problem("", "an escape in quotes stands for no character")
        raise kind(source, [problem]) from None
    return root


def scalar(node: yaml.ScalarNode) -> object:
    """A plain value; what a tag calls a number and is none stays text."""
    kind, text = node.tag.removeprefix(TAG), str(node.value)
    if kind == "null":
        return None
    if kind == "bool":
        return text == "true"
    if kind == "int" and _WHOLE.fullmatch(text):
        return whole_number(text)
    if kind == "float" and _FLOAT.fullmatch(text):
        return float(text.replace(".inf", "inf").replace(".nan", "nan"))
    return text


def foreign(node: yaml.Node) -> bool:
    """Whether the node has a tag of its own, which means nothing here."""
    plain = {f"{TAG}{kind}" for kind in ("null", "bool", "int", "float", "str", "seq", "map")}
    return node.tag not in plain
