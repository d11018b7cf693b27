"""Where a graph of states leads: who can reach a goal, and what is never left again."""

from collections.abc import Collection, Iterable, Sequence


def reaching(successors: Sequence[Collection[int]], goals: Iterable[int]) -> list[bool]:
    """For each vertex, whether a path leads from it to a goal.

    Args:
        successors: of each vertex.
        goals: vertices.
    """
    predecessors: list[list[int]] = [[] for _ in successors]
    for vertex, following in enumerate(successors):
        for one in following:
            predecessors[one].append(vertex)
    reached = [False] * len(successors)
    stack = list(goals)
    for goal in stack:
        reached[goal] = True
    while stack:
        for one in predecessors[stack.pop()]:
            if not reached[one]:
                reached[one] = True
                stack.append(one)
    return reached


def components(successors: Sequence[Collection[int]]) -> list[list[int]]:
    """The strongly connected components, by Tarjan's algorithm without recursion.

    Args:
        successors: of each vertex.

    Returns:
        Each component; one comes after all that it leads to.
    """
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    waiting: set[int] = set()
    found: list[list[int]] = []
    for start in range(len(successors)):
        if start in order:
            continue
        work = [(start, iter(successors[start]))]
        order[start] = low[start] = len(order)
        stack.append(start)
        waiting.add(start)
        while work:
            vertex, following = work[-1]
            for one in following:
                if one not in order:
                    order[one] = low[one] = len(order)
                    stack.append(one)
                    waiting.add(one)
                    work.append((one, iter(successors[one])))
                    break
                if one in waiting:
                    low[vertex] = min(low[vertex], order[one])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[vertex])
                if low[vertex] == order[vertex]:
                    found.append(_popped(stack, waiting, vertex))
    return found


def _popped(stack: list[int], waiting: set[int], root: int) -> list[int]:
    """The component above a root on the stack, taken off it."""
    component: list[int] = []
    while not component or component[-1] != root:
        component.append(stack.pop())
    waiting.difference_update(component)
    return component


def last_components(
    successors: Sequence[Collection[int]], among: Collection[int]
) -> list[list[int]]:
    """The components that nothing leads out of, of those that lie among some vertices."""
    chosen = set(among)
    last = []
    for component in components(successors):
        inside = set(component)
        if inside <= chosen and all(one in inside for v in component for one in successors[v]):
            last.append(sorted(component))
    return last
