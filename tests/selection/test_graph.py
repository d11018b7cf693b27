"""The graph G: what it says, and that it stays right through any sequence of changes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from piles import box, cut, cut_piles, cycle_of_four, loose_piles, slow_edges, slow_reach

from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.errors import PileError
from depal.geometry import OrientedBox
from depal.selection import EXACT, PERCEIVED, BlockingGraph, Relation
from depal.selection.links import Links

Signature = dict[BoxId, frozenset[tuple[BoxId, Relation]]]


def signature(graph: BlockingGraph) -> Signature:
    """All edges, without their order."""
    return {
        seen.id: frozenset((b.box, b.relation) for b in graph.blockers(seen.id)) for seen in graph
    }


@given(cut_piles())
def test_t_is_everything_reachable(boxes: list[Detection]) -> None:
    """T(b), itself included."""
    graph = BlockingGraph(boxes, EXACT)
    edges = slow_edges(boxes)
    for seen in boxes:
        assert graph.reachable(seen.id) == slow_reach(edges, seen.id)


@given(cut_piles())
def test_guillotine_packings_have_no_cycle(boxes: list[Detection]) -> None:
    """And so there is always a leaf."""
    graph = BlockingGraph(boxes, EXACT)
    assert graph.cycle() == ()
    while len(graph):
        leaves = graph.leaves()
        assert leaves
        graph.remove(min(leaves))


@given(loose_piles(), st.randoms(use_true_random=False))
def test_neither_names_nor_order_change_the_graph(boxes: list[Detection], random: object) -> None:
    """The same poses give the same edges."""
    names = {seen.id: BoxId(f"other{number}") for number, seen in enumerate(boxes)}
    renamed = [Detection(names[seen.id], seen.shape) for seen in boxes]
    random.shuffle(renamed)  # type: ignore[attr-defined]
    before, after = signature(BlockingGraph(boxes)), signature(BlockingGraph(renamed))
    assert after == {
        names[name]: frozenset((names[b], relation) for b, relation in blockers)
        for name, blockers in before.items()
    }


def test_a_planted_cycle_is_named_from_its_first_box_by_geometry() -> None:
    """Each box is blocked by the next; what they block in turn is stuck but not in the cycle."""
    graph = BlockingGraph([*cycle_of_four(), box("under", (1.4, 0, -0.1), (0.4, 0.4, 0.1))], EXACT)
    assert graph.cycle() == ("d", "a", "b", "c")
    assert graph.leaves() == frozenset()
    graph.remove(BoxId("c"))
    assert graph.cycle() == ()
    assert graph.leaves() == {"b"}


@pytest.mark.parametrize("capacity", [0, 1, 40])
def test_a_pool_of_edges_grows_without_losing_any(capacity: int) -> None:
    """Whatever room there was."""
    links = Links.empty(2, capacity).grown(5, 60)
    free, edge = [], int(links.free[0])
    while edge >= 0:
        free.append(edge)
        edge = int(links.edges[edge, 3])
    assert sorted(free) == list(range(60))


def test_a_copy_of_the_edges_is_changed_on_its_own() -> None:
    """As the studies do, run by run."""
    graph = BlockingGraph(cut(2, 10), EXACT)
    copied = graph.links.copy()
    before = [array.copy() for array in copied]
    for seen in list(graph):
        graph.remove(seen.id)
    assert all(np.array_equal(a, b) for a, b in zip(before, copied, strict=True))


def test_more_edges_than_first_thought_are_found_too() -> None:
    """A hundred thin plates on one another: every one blocked by all above it."""
    plates = [box(f"p{i}", (1.4, 0, i * 0.01), (0.4, 0.4, 0.01)) for i in range(100)]
    assert BlockingGraph(plates, EXACT).edges == 100 * 99 // 2


def test_the_memory_is_that_of_its_arrays() -> None:
    """Something, and more for more."""
    small, large = (BlockingGraph(cut(1, n), EXACT).nbytes for n in (10, 30))
    assert 0 < small < large


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (
            lambda graph: graph.add(box("a", (3.0, 0, 0), (0.1, 0.1, 0.1))),
            "pile: two boxes are called 'a'; expected a name of its own for every box",
        ),
        (
            lambda graph: graph.remove(BoxId("b12")),
            "pile: no box 'b12' is perceived; there is: a, b",
        ),
        (
            lambda graph: graph.add(box("c", (1.41, 0.01, 0.0), (0.4, 0.4, 0.4))),
            (
                "pile at (1.610, 0.210, 0.200) m: boxes 'a' and 'c' are in one place; "
                "expected boxes that stand beside each other"
            ),
        ),
        (
            lambda graph: graph.move(box("b", (1.41, 0.01, 0.0), (0.4, 0.4, 0.4))),
            (
                "pile at (1.610, 0.210, 0.200) m: boxes 'a' and 'b' are in one place; "
                "expected boxes that stand beside each other"
            ),
        ),
        (
            lambda graph: graph.update([*graph, box("c", (1.41, 0.01, 0.0), (0.4, 0.4, 0.4))]),
            (
                "pile at (1.610, 0.210, 0.200) m: boxes 'a' and 'c' are in one place; "
                "expected boxes that stand beside each other"
            ),
        ),
        (
            lambda graph: graph.update(
                [box("a", (0, 0, 0), (1, 1, 1))] * 1 + [box("a", (5, 0, 0), (1, 1, 1))]
            ),
            "pile: two boxes are called 'a'; expected a name of its own for every box",
        ),
        (lambda graph: graph["z"], "pile: no box 'z' is perceived; there is: a, b"),
    ],
)
def test_what_cannot_stand_in_one_world_is_refused_and_changes_nothing(
    act: object, message: str
) -> None:
    """One clear error, and the graph as it was."""
    graph = BlockingGraph(
        [box("a", (1.4, 0, 0), (0.4, 0.4, 0.4)), box("b", (1.4, 0, 0.4), (0.4, 0.4, 0.4))], EXACT
    )
    before = signature(graph)
    assert callable(act)
    with pytest.raises(PileError) as caught:
        act(graph)
    assert str(caught.value) == message
    assert signature(graph) == before
    assert len(graph) == 2


def test_two_boxes_in_one_place_or_of_one_name_make_no_graph() -> None:
    """Refused from the start."""
    one = box("a", (1.4, 0, 0), (0.4, 0.4, 0.4))
    with pytest.raises(PileError, match="boxes 'a' and 'b' are in one place"):
        BlockingGraph([one, box("b", (1.4, 0, 0), (0.4, 0.4, 0.4))])
    with pytest.raises(PileError, match="two boxes are called 'a'"):
        BlockingGraph([one, one])


def test_a_box_that_is_recognised_later_keeps_its_edges() -> None:
    """Only what is known of it changes."""
    boxes = cut(3, 12)
    graph = BlockingGraph(boxes, EXACT)
    before = signature(graph)
    named = Recognition(boxes[4].id, boxes[4].shape, Gtin("12000823098180"))
    graph.update([*boxes[:4], named, *boxes[5:]])
    assert signature(graph) == before
    assert graph[boxes[4].id] == named


def test_an_empty_slot_holds_no_box() -> None:
    """Reading it is a mistake of the program."""
    graph = BlockingGraph(cut(3, 5), EXACT)
    graph.remove(BoxId("b0"))
    assert "b0" not in graph
    assert graph.slot_of(BoxId("b0")) is None
    with pytest.raises(LookupError):
        graph.at(0)


class Changes(RuleBasedStateMachine):
    """Removals, arrivals, small changes of poses, and whole looks, in any sequence."""

    graph: BlockingGraph
    world: dict[BoxId, Perceived]
    rng: np.random.Generator
    born: int

    @initialize(seed=st.integers(0, 2**32 - 1), count=st.integers(0, 12))
    def start(self, seed: int, count: int) -> None:
        """A pile out of cuts."""
        boxes = cut(seed, count) if count else []
        self.rng = np.random.default_rng(seed)
        self.world = {seen.id: seen for seen in boxes}
        self.graph = BlockingGraph(boxes, PERCEIVED)
        self.born = 0

    def _some(self) -> Perceived:
        names = sorted(self.world)
        return self.world[names[int(self.rng.integers(len(names)))]]

    def _nudged(self, seen: Perceived) -> Perceived:
        dx, dy, dz, yaw = self.rng.normal(0, 0.02, 4).tolist()
        x, y, z = seen.shape.centre
        shape = OrientedBox.upright((x + dx, y + dy, z + dz), seen.shape.size, yaw)
        return Detection(seen.id, shape)

    @precondition(lambda self: self.world)
    @rule()
    def leaves(self) -> None:
        """One box goes."""
        seen = self._some()
        self.graph.remove(seen.id)
        del self.world[seen.id]

    @rule()
    def comes(self) -> None:
        """A new box, anywhere; refused where another one stands."""
        self.born += 1
        x, y, z, a, b, c = self.rng.uniform(0.1, 0.5, 6).tolist()
        shape = OrientedBox.upright((1.4 + 2 * x, 4 * y - 1.2, 2 * z), (a, b, c), 0.05)
        seen = Detection(BoxId(f"n{self.born}"), shape)
        try:
            self.graph.add(seen)
        except PileError:
            return
        self.world[seen.id] = seen

    @precondition(lambda self: self.world)
    @rule()
    def moves(self) -> None:
        """A box is seen a little elsewhere."""
        seen = self._nudged(self._some())
        try:
            self.graph.move(seen)
        except PileError:
            return
        self.world[seen.id] = seen

    @rule()
    def looks(self) -> None:
        """Everything is seen a little elsewhere, at once."""
        now = {name: self._nudged(seen) for name, seen in self.world.items()}
        try:
            self.graph.update(now.values())
        except PileError:
            return
        self.world = now

    @invariant()
    def equals_the_rebuilt_graph(self) -> None:
        """Edge by edge, and so does its cycle."""
        if not hasattr(self, "graph"):
            return
        rebuilt = BlockingGraph(self.world.values(), PERCEIVED)
        assert signature(self.graph) == signature(rebuilt)
        assert self.graph.edges == rebuilt.edges
        assert self.graph.leaves() == rebuilt.leaves()
        assert self.graph.cycle() == rebuilt.cycle()
        assert len(self.graph) == len(self.world)


TestChanges = Changes.TestCase
