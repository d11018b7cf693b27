"""Who uses which resource, and who keeps one between uses."""

from collections.abc import Iterable, Mapping

from depal.executive.nodes import LiveNode
from depal.executive.schema import Resource, Task


class Holdings:
    """The units of every resource.

    A running primitive uses one unit of each resource that it claims. A task that keeps a
    resource holds one unit from the first use inside it until it is accomplished or disabled; while
    only `within` does not hold it keeps it. Users inside a keeper use the keeper's unit.
    """

    def __init__(self, resources: Mapping[str, Resource]) -> None:
        """Everything is free; `version` is another number whenever that has changed."""
        self.version = 0
        self._capacity = {name: resource.capacity for name, resource in resources.items()}
        self._users: dict[str, dict[int, LiveNode]] = {name: {} for name in resources}
        self._keepers: dict[str, list[LiveNode]] = {name: [] for name in resources}
        self._all_keepers: list[LiveNode] = []
        self._closed: set[str] = set()

    def users(self, resource: str) -> Mapping[int, LiveNode]:
        """The nodes that use a resource, by attempt."""
        return self._users[resource]

    @property
    def keepers(self) -> list[LiveNode]:
        """Every task that keeps something."""
        return self._all_keepers

    @property
    def closed(self) -> set[str]:
        """The resources of which keepers have every unit: nobody outside gets one."""
        return self._closed

    def kept(self) -> Iterable[tuple[str, LiveNode]]:
        """Every kept resource with its keeper."""
        return ((name, node) for name, nodes in self._keepers.items() for node in nodes)

    def keeper_above(self, node: LiveNode, resource: str) -> LiveNode | None:
        """The keeper of a resource that a node stands within, if any."""
        for keeper in self._keepers[resource]:
            if node.is_within(keeper):
                return keeper
        return None

    def is_free_for(self, node: LiveNode, resource: str) -> bool:
        """Whether a node could use a unit now."""
        keepers = self._keepers[resource]
        users = self._users[resource]
        if not keepers:
            return len(users) < self._capacity[resource]
        keeper = self.keeper_above(node, resource)
        if keeper is not None:
            return not any(user.is_within(keeper) for user in users.values())
        outside = sum(
            not any(user.is_within(keeper) for keeper in keepers) for user in users.values()
        )
        return outside + len(keepers) < self._capacity[resource]

    def is_kept_from(self, node: LiveNode, resource: str) -> bool:
        """Whether only keepers stand between a node and a unit: waiting will not be short."""
        return resource in self._closed and self.keeper_above(node, resource) is None

    def use(self, attempt: int, node: LiveNode) -> None:
        """A primitive uses one unit of each resource that it claims."""
        self.version += 1
        for resource in node.action.uses:
            self._users[resource][attempt] = node

    def take(self, attempt: int, node: LiveNode) -> None:
        """A primitive starts; tasks above that keep what it uses become keepers."""
        self.use(attempt, node)
        for resource in node.action.uses:
            above = node.parent
            while above is not None:
                schema = above.node.schema
                keeps = isinstance(schema, Task) and resource in schema.keeps
                if keeps and self.keeper_above(node, resource) is None:
                    self.keep(resource, above)
                above = above.parent

    def keep(self, resource: str, node: LiveNode) -> None:
        """A task keeps a unit of a resource."""
        if node not in self._keepers[resource]:
            self._keepers[resource].append(node)
            self._recount(resource)

    def keep_again(self, node: LiveNode) -> None:
        """A task is kept again: it keeps what a primitive inside still uses."""
        schema = node.node.schema
        if isinstance(schema, Task):
            for resource in schema.keeps:
                in_use = any(user.is_within(node) for user in self._users[resource].values())
                if in_use and self.keeper_above(node, resource) is None:
                    self.keep(resource, node)

    def give_back(self, attempt: int, node: LiveNode) -> None:
        """A primitive has ended."""
        self.version += 1
        for resource in node.action.uses:
            self._users[resource].pop(attempt, None)

    def stop_keeping(self, node: LiveNode) -> None:
        """A task is accomplished, disabled or withdrawn."""
        schema = node.node.schema
        if isinstance(schema, Task):
            for resource in schema.keeps:
                if node in self._keepers[resource]:
                    self._keepers[resource].remove(node)
                    self._recount(resource)

    def _recount(self, resource: str) -> None:
        self.version += 1
        self._all_keepers = [node for nodes in self._keepers.values() for node in nodes]
        if len(self._keepers[resource]) >= self._capacity[resource]:
            self._closed.add(resource)
        else:
            self._closed.discard(resource)
