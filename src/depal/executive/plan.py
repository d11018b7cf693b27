"""Plans: what the nodes of a task are for every set of true atoms, for all arguments at once.

    true atoms -> which nodes may run, which are accomplished, which atoms matter

This is the definition of the states; it is worked out when a set of atoms occurs for the first
time, and looked up from then on.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.executive.atoms import Atoms, Formula, Subject, filled, members, stand_ins
from depal.executive.conditions import Key, Lasting, Value, lasting_of
from depal.executive.schema import Repository, Task
from depal.executive.spans import Span
from depal.executive.stamp import Stamp
from depal.executive.tree import Node, ground

ROOM = 4096
"""So many sets of atoms a plan remembers."""


@dataclass(frozen=True, slots=True)
class Gates:
    """What a set of true atoms means. Sets of nodes and of atoms are written as numbers.

    Attributes:
        open: the nodes that may run.
        kept: the nodes that could if all held that must hold throughout.
        awake: the nodes whose parent is kept, and the root; below the others nothing can run.
        accomplished: the nodes whose postcondition holds; certain for those that are awake.
        needed: the atoms that awake nodes mention.
    """

    open: int
    kept: int
    awake: int
    accomplished: int
    needed: int


SHUT = Gates(0, 0, 0, 0, 0)
"""Of a tree of which nothing may run any more."""


@dataclass(frozen=True, slots=True)
class Part:
    """What a node asks of the atoms.

    Attributes:
        bit: the set of this node alone.
        parent: the set of its parent alone; empty for the root.
        pre: the preconditions of its edge and of its schema.
        within: what must hold as long as anything of it runs.
        post: its postcondition.
        mentioned: the atoms of all.
        decisive: the atoms of `post`.
    """

    bit: int
    parent: int
    pre: Formula
    within: Formula
    post: Formula
    mentioned: int
    decisive: int


class Plan:
    """A task for all arguments.

    Attributes:
        arity: how many arguments it takes.
        stamp: makes its nodes.
        atoms: of its conditions.
        parts: one a node.
        own: the atoms that are always watched; the others are watched while they are needed.
        keepers: the nodes that do something when they are kept or no more.
        concrete: the nodes that are primitives; they do something when their gate moves.
        timed: its time conditions, inner ones first: the condition, the node that mentions it and
            whether its edge does.
    """

    def __init__(self, repository: Repository, name: str, facts: dict[Key, Value]) -> None:
        """Grounds a task for arguments that are not known yet.

        Args:
            repository: of schemata.
            name: the task, known there.
            facts: what is the case; atoms are tested on them.
        """
        self.arity = len(repository.schemata[name].params)
        nodes = ground(repository, name, stand_ins(self.arity)).nodes
        self.stamp = Stamp(nodes)
        atoms = Atoms(facts)
        self.timed = [timed for node in nodes for timed in _time_conditions(node, atoms)]
        self.parts = [_part(node, atoms) for node in nodes]
        self.atoms = atoms.found
        self.own = sum(1 << number for number, atom in enumerate(self.atoms) if atom.own)
        self.concrete = sum(1 << node.index for node in nodes if node.concrete)
        keepers = (n for n in nodes if isinstance(n.schema, Task) and n.schema.keeps)
        self.keepers = sum(1 << node.index for node in keepers)
        self._words = filled(atoms.words)
        self._known: dict[int, Gates] = {}
        self._moves: dict[tuple[int, int, int, int], list[tuple[int, bool, bool]]] = {}

    def subject(self, args: Sequence[str], spans: Sequence[Span]) -> Subject:
        """What the tree with these arguments and time conditions is about."""
        subject = Subject(self._words(args), spans)
        subject.watches = [atom.watches(subject) for atom in self.atoms]
        return subject

    def gates(self, true: int) -> Gates:
        """What the nodes are while exactly these atoms are true."""
        known = self._known.get(true)
        if known is None:
            if len(self._known) >= ROOM:
                self._known.clear()
            known = self._known[true] = self._worked_out(true)
        return known

    def moves(self, before: Gates, after: Gates) -> list[tuple[int, bool, bool]]:
        """What moves and is noticed: the node, whether it opens, whether it is concrete.

        Of primitives it is the gate; of keepers, whether they are kept. Parents come before their
        children.
        """
        change = before.open, before.kept, after.open, after.kept
        known = self._moves.get(change)
        if known is None:
            if len(self._moves) >= ROOM:
                self._moves.clear()
            moved = (before.open ^ after.open) & self.concrete
            moved |= (before.kept ^ after.kept) & self.keepers
            now = after.open & self.concrete | after.kept & self.keepers
            known = self._moves[change] = [
                (index, now >> index & 1 == 1, self.concrete >> index & 1 == 1)
                for index in members(moved)
            ]
        return known

    def _worked_out(self, true: int) -> Gates:
        opened = kept = awake = accomplished = needed = 0
        for part in self.parts:
            if part.post(true):
                accomplished |= part.bit
            if part.parent and not kept & part.parent:
                continue
            awake |= part.bit
            needed |= part.mentioned
            if part.pre(true) and not accomplished & part.bit:
                kept |= part.bit
                if part.within(true) and (not part.parent or opened & part.parent):
                    opened |= part.bit
        return Gates(opened, kept, awake, accomplished, needed)


def _time_conditions(node: Node, atoms: Atoms) -> list[tuple[Lasting, int, bool]]:
    """Those that a node is the first to mention."""
    schema = node.schema
    own = [
        *lasting_of(schema.when),
        *lasting_of(schema.within),
        *lasting_of(schema.until),
    ]
    found = [(lasting, node.index, False) for lasting in own if atoms.time(lasting, node.binding)]
    found += [
        (lasting, node.index, True)
        for lasting in lasting_of(node.edge)
        if atoms.time(lasting, node.edge_binding)
    ]
    return found


def _part(node: Node, atoms: Atoms) -> Part:
    edge, on_edge = atoms.read(node.edge, node.edge_binding)
    own, on_own = atoms.read(node.schema.when, node.binding)
    within, throughout = atoms.read(node.schema.within, node.binding)
    post, decisive = atoms.read(node.schema.until, node.binding)
    parent = 1 << node.parent if node.parent >= 0 else 0
    return Part(
        1 << node.index,
        parent,
        lambda true: edge(true) and own(true),
        within,
        post,
        on_edge | on_own | throughout | decisive,
        decisive,
    )
