"""Components and reachability against their definitions."""

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from depal.executive.exploring.components import components, last_components, reaching

graphs = st.integers(1, 12).flatmap(
    lambda size: st.lists(
        st.sets(st.integers(0, size - 1), max_size=4), min_size=size, max_size=size
    )
)


def as_networkx(graph: list[set[int]]) -> "nx.DiGraph[int]":
    """The same graph in another library."""
    other: nx.DiGraph[int] = nx.DiGraph()
    other.add_nodes_from(range(len(graph)))
    other.add_edges_from((v, one) for v, following in enumerate(graph) for one in following)
    return other


@given(graphs)
def test_components_are_those_of_networkx_and_come_after_what_they_lead_to(
    graph: list[set[int]],
) -> None:
    """Each vertex is in one."""
    found = components(graph)
    expected = {frozenset(one) for one in nx.strongly_connected_components(as_networkx(graph))}
    assert {frozenset(one) for one in found} == expected
    at = {vertex: place for place, one in enumerate(found) for vertex in one}
    assert all(at[one] <= at[v] for v, following in enumerate(graph) for one in following)


@given(graphs, st.sets(st.integers(0, 11)))
def test_reaching_is_what_descendants_say(graph: list[set[int]], wanted: set[int]) -> None:
    """A goal reaches itself."""
    goals = {goal for goal in wanted if goal < len(graph)}
    other = as_networkx(graph)
    expected = [bool(({v} | nx.descendants(other, v)) & goals) for v in range(len(graph))]
    assert reaching(graph, goals) == expected


@given(graphs)
def test_nothing_leads_out_of_a_last_component(graph: list[set[int]]) -> None:
    """And everything leads into one."""
    last = last_components(graph, range(len(graph)))
    inside = [vertex for one in last for vertex in one]
    assert all(set(graph[v]) <= set(one) for one in last for v in one)
    assert all(reaching(graph, inside))


def test_a_long_chain_needs_no_recursion() -> None:
    """Deeper than Python's own stack."""
    size = 20_000
    assert len(components([{v + 1} if v + 1 < size else set() for v in range(size)])) == size
