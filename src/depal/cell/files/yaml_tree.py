"""A YAML text as plain values that know the lines they stand on."""

from dataclasses import dataclass

import yaml

from depal.errors import CellError, Problem
from depal.logistics.findings import Finding, Loc, shown
from depal.logistics.yaml_text import TAG, composed, foreign, scalar

_DEEPEST = 12
"""No path of the format is longer."""

_MOST_NODES = 20_000
"""No cell has more values; aliases of aliases could stand for any number."""


@dataclass(frozen=True, slots=True)
class YamlTree:
    """What a file holds.

    Attributes:
        value: dictionaries, lists and plain values.
        lines: the line on which each of them begins, from 1.
        findings: what YAML allows and the format does not.
    """

    value: object
    lines: dict[Loc, int]
    findings: tuple[Finding, ...]

    def line(self, loc: Loc) -> int:
        """The line of the nearest thing that exists on the way to a place."""
        while loc and loc not in self.lines:
            loc = loc[:-1]
        return self.lines.get(loc, 1)


def tree_of_yaml(text: str, source: str) -> YamlTree:
    """The values of a YAML text.

    Args:
        text: the text.
        source: where it comes from, for the error.

    Returns:
        The values, and the line of each.

    Raises:
        CellError: the text is not YAML, with line and column; or it is no object.
    """
    root = composed(text, source, CellError, "a cell")
    if root is None:
        raise CellError(source, [Problem("", "is empty", "a cell: robot, tool, pallet, ...")])
    if not isinstance(root, yaml.MappingNode):
        where = f"line {root.start_mark.line + 1}"
        raise CellError(source, [Problem(where, "is not an object", "a cell: robot, tool, ...")])
    walk = _Walk(source)
    value = walk.value(root, ())
    return YamlTree(value, walk.lines, tuple(walk.findings))


class _Walk:
    """One way through all nodes."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._count = 0
        self.lines: dict[Loc, int] = {}
        self.findings: list[Finding] = []

    def value(self, node: yaml.Node, loc: Loc) -> object:
        """The value of a node; what is inside of it comes first."""
        self._count += 1
        if len(loc) > _DEEPEST or self._count > _MOST_NODES:
            where = f"line {node.start_mark.line + 1}"
            problem = Problem(where, "too deep or too large to be a cell")
            raise CellError(self._source, [problem])
        self.lines.setdefault(loc, node.start_mark.line + 1)
        if foreign(node):
            tag = shown(node.tag.removeprefix(TAG))
            self.findings.append(Finding(loc, f"the tag {tag} has no meaning here"))
        if isinstance(node, yaml.SequenceNode):
            return [self.value(inner, (*loc, index)) for index, inner in enumerate(node.value)]
        if isinstance(node, yaml.MappingNode):
            return self._object(node, loc)
        return scalar(node) if isinstance(node, yaml.ScalarNode) else None

    def _object(self, node: yaml.MappingNode, loc: Loc) -> dict[str, object]:
        inside: dict[str, object] = {}
        for key_node, value_node in node.value:
            key = str(key_node.value) if isinstance(key_node, yaml.ScalarNode) else "a list"
            here = (*loc, key)
            if key in inside:
                what = "the key stands here twice"
                self.findings.append(Finding(here, what, "every key once"))
            self.lines.setdefault(here, key_node.start_mark.line + 1)
            inside[key] = self.value(value_node, here)
        return inside
