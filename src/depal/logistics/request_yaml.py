"""Files of requests as YAML: a list of flat objects, each of which knows its lines."""

from dataclasses import dataclass

import yaml

from depal.errors import Problem, RequestError
from depal.logistics.findings import Finding, shown
from depal.logistics.yaml_text import TAG, composed, foreign, scalar


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
    root = composed(text, source, RequestError, "requests")
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
        if foreign(value_node):
            tag = shown(value_node.tag.removeprefix(TAG))
            findings.append(Finding((key,), f"the tag {tag} has no meaning here"))
        value[key] = _value(value_node)
        lines.setdefault(key, key_node.start_mark.line + 1)
    return YamlItem(value, line, lines, tuple(findings))


def _value(node: yaml.Node) -> object:
    if isinstance(node, yaml.ScalarNode):
        return scalar(node)
    return {} if isinstance(node, yaml.MappingNode) else []
