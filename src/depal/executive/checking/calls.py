"""Who calls whom: recursion, roots, and what nobody uses."""

from collections.abc import Iterator

from depal.executive.checking.findings import Finding, FindingKind, head_of
from depal.executive.exploring.components import components
from depal.executive.schema import Repository, Task


class Calls:
    """The graph of calls.

    Attributes:
        called: the schemata that each one calls, without unknown ones, by name.
        roots: the tasks that no other one calls.
        endless: the tasks that call themselves, directly or through others.
    """

    def __init__(self, repository: Repository) -> None:
        """Follows every step."""
        self._repository = repository
        self.called = {
            schema.name: tuple(
                dict.fromkeys(s.schema for s in schema.steps if s.schema in repository.schemata)
            )
            if isinstance(schema, Task)
            else ()
            for schema in repository.schemata.values()
        }
        wanted = {name for caller, names in self.called.items() for name in names if name != caller}
        tasks = [one.name for one in repository.schemata.values() if isinstance(one, Task)]
        self.roots = [name for name in tasks if name not in wanted]
        self.unused = [name for name in self.called if name not in wanted and name not in tasks]
        self.endless = list(self._circles())

    def _circles(self) -> Iterator[list[str]]:
        names = list(self.called)
        index = {name: place for place, name in enumerate(names)}
        graph = [[index[one] for one in self.called[name]] for name in names]
        for component in components(graph):
            circle = sorted(names[one] for one in component)
            if len(circle) > 1 or circle[0] in self.called[circle[0]]:
                yield circle

    def below(self, root: str) -> set[str]:
        """A schema and everything that it calls, directly or through others."""
        found = {root}
        stack = [root]
        while stack:
            for name in self.called[stack.pop()]:
                if name not in found:
                    found.add(name)
                    stack.append(name)
        return found

    def findings(self) -> Iterator[Finding]:
        """Endless recursion, unused actions, and uncalled tasks beside others."""
        schemata = self._repository.schemata
        for circle in self.endless:
            what = f"{' and '.join(circle)} call one another without end"
            if len(circle) == 1:
                what = f"{circle[0]} calls itself without end"
            yield Finding(FindingKind.ENDLESS, head_of(schemata[circle[0]]), what)
        for name in self.unused:
            yield Finding(FindingKind.UNUSED_ACTION, head_of(schemata[name]), "no task uses it")
        if len(self.roots) > 1:
            for name in self.roots:
                what = "no task calls it; it runs only when it is asked for"
                yield Finding(FindingKind.UNCALLED_TASK, head_of(schemata[name]), what)
