"""Resources in an abstract state: who may take one, who keeps one, whether too many have one."""

from collections import Counter
from collections.abc import Sequence

from depal.executive.exploring.model import Model
from depal.executive.tree import Standing

Keepers = tuple[tuple[int, str], ...]
"""Pairs of a task's node and a resource that it keeps."""


class Claims:
    """The rules of claiming: all or none, one unit each, users inside a keeper use its unit."""

    def __init__(self, model: Model) -> None:
        """Looks up the capacities."""
        self._model = model
        self._capacity = {name: one.capacity for name, one in model.resources.items()}

    def missing(self, place: int, running: Sequence[int], keepers: Keepers) -> str | None:
        """The first resource that a primitive would have to wait for, with who has it."""
        node = self._model.primitives[place].node
        for name in self._model.primitives[place].action.uses:
            if name not in self._capacity:
                continue
            users = [one for one in running if name in self._model.primitives[one].action.uses]
            above = self._keeper_above(node.index, name, keepers)
            if above is not None:
                inside = [one for one in users if self._within(one, above)]
                if inside:
                    return f"{name}, used by {self._labels(inside)}"
                continue
            kept = [keeper for keeper, resource in keepers if resource == name]
            outside = [one for one in users if not any(self._within(one, k) for k in kept)]
            if len(kept) + len(outside) >= self._capacity[name]:
                who = [self._model.tree.nodes[keeper].label for keeper in kept]
                verb = "kept by" if kept else "used by"
                holders = ", ".join([*who, *filter(None, [self._labels(outside)])])
                return f"{name}, {verb} {holders}" if holders else f"{name}, which has no capacity"
        return None

    def keepers_after(self, place: int, keepers: Keepers) -> Keepers:
        """Who keeps what once a primitive has started."""
        node = self._model.primitives[place].node
        found = list(keepers)
        for name in self._model.primitives[place].action.uses:
            above = self._model.keepers_of(node, name)
            if above and self._keeper_above(node.index, name, tuple(found)) is None:
                found.append((above[0], name))
        return tuple(sorted(found))

    def still_kept(self, keepers: Keepers, standings: Sequence[Standing]) -> Keepers:
        """The keepers that are neither accomplished nor disabled but for their `within`."""
        return tuple(keeper for keeper in keepers if standings[keeper[0]].kept)

    def clashes(self, running: Sequence[int]) -> list[str]:
        """What must not run at once and does: too many users, or two that set the same fact."""
        found = []
        used = Counter(name for one in running for name in self._model.primitives[one].action.uses)
        for name, count in used.items():
            users = [one for one in running if name in self._model.primitives[one].action.uses]
            if count > self._capacity.get(name, count):
                found.append(
                    f"{self._labels(users)} use {name} at once; capacity {self._capacity[name]}"
                )
        for at, one in enumerate(running):
            for other in running[at + 1 :]:
                shared = set(self._model.primitives[one].changes).intersection(
                    self._model.primitives[other].changes
                )
                if shared:
                    facts = ", ".join(sorted(shared))
                    who = self._labels([one, other])
                    found.append(f"{who} run at once, and each may set {facts}")
        return found

    def _keeper_above(self, index: int, name: str, keepers: Keepers) -> int | None:
        for keeper, resource in keepers:
            if resource == name and self._model.is_within(index, keeper):
                return keeper
        return None

    def _within(self, place: int, keeper: int) -> bool:
        return self._model.is_within(self._model.primitives[place].node.index, keeper)

    def _labels(self, places: Sequence[int]) -> str:
        names = [self._model.primitives[place].node.label for place in places]
        return " and ".join(names)
