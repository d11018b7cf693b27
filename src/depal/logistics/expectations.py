"""What a file format's own schema says about each place in a file."""

from dataclasses import dataclass
from typing import Any

from depal.logistics.findings import Loc

Schema = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Expectations:
    """Answers about places in a file, read from the JSON Schema of one object in it.

    Attributes:
        schema: the schema of the object; its references lead into its own `$defs`.
    """

    schema: Schema

    def expected(self, loc: Loc) -> str:
        """What the schema says about a place, as part of a sentence; empty where nothing."""
        said = str(self._at(loc).get("description", ""))
        return f"{said[:1].lower()}{said[1:].removesuffix('.')}"

    def keys(self, loc: Loc) -> list[str]:
        """The keys that the object at a place may have, in the order of the format."""
        return list(self._at(loc).get("properties", {}))

    def order(self, loc: Loc) -> tuple[int, ...]:
        """Sorts places as the format lists them; what the format does not know comes last."""
        ranks = []
        for depth, step in enumerate(loc):
            if isinstance(step, int):
                ranks.append(step)
            else:
                known = self.keys(loc[:depth])
                ranks.append(known.index(step) if step in known else len(known))
        return tuple(ranks)

    def _at(self, loc: Loc) -> Schema:
        node = self.schema
        for step in loc:
            inner = node.get("items", {}) if isinstance(step, int) else self._property(node, step)
            reference = str(inner.get("$ref", "")).removeprefix("#/$defs/")
            node = {**self.schema["$defs"][reference], **inner} if reference else inner
        return node

    @staticmethod
    def _property(node: Schema, name: str) -> Schema:
        inner: Schema = node.get("properties", {}).get(name, {})
        return inner
