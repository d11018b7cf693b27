"""Conditions and facts of grounded schemata: variables replaced, declarations looked up."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from depal.executive.conditions import (
    AllOf,
    Always,
    AnyOf,
    Binding,
    Compare,
    Condition,
    FactRef,
    Holds,
    Lasting,
    Literal,
    Not,
    Operand,
    Var,
    facts_of,
    key_of,
)
from depal.executive.schema import BASIC_KINDS, FactDeclaration, Repository, Schema
from depal.executive.tree import Node, Tree

Sorts = Mapping[str, str]
"""The sort of each parameter of a schema, by its name."""


def sorts_of(schema: Schema) -> Sorts:
    """The sort of each parameter."""
    return {param.name: param.sort for param in schema.params}


def known_sorts(repository: Repository) -> frozenset[str]:
    """Every sort of things that a fact may hold or a parameter stands for."""
    held = {kind for fact in repository.facts.values() for kind in fact.type.kinds}
    params = {param.sort for schema in repository.schemata.values() for param in schema.params}
    return frozenset((held | params) - set(BASIC_KINDS))


def declaration_of(repository: Repository, fact: FactRef, sorts: Sorts) -> FactDeclaration | None:
    """The declaration behind a fact as it is written.

    Args:
        repository: with the declarations.
        fact: as written; the subject is a parameter or the name of one thing.
        sorts: of the parameters.

    Returns:
        The declaration of that thing, else of the sort that it may belong to; None where
        neither exists.
    """
    if isinstance(fact.subject, Var):
        sort = sorts.get(fact.subject.name)
        return None if sort is None else repository.facts.get(f"{sort}.{fact.attribute}")
    thing = str(fact.subject.value)
    found = repository.facts.get(f"{thing}.{fact.attribute}")
    if found is not None:
        return found
    groups = known_sorts(repository)
    if thing in groups:
        return None
    for declaration in repository.facts.values():
        if declaration.attribute == fact.attribute and declaration.subject in groups:
            return declaration
    return None


def grounded(condition: Condition, binding: Binding) -> Condition:
    """The same condition with names in place of the parameters."""
    match condition:
        case Always():
            return condition
        case Holds(fact):
            return Holds(_fact(fact, binding))
        case Compare(fact, op, other):
            right = _fact(other, binding) if isinstance(other, FactRef) else _name(other, binding)
            return Compare(_fact(fact, binding), op, right)
        case Not(part) | Lasting(part, _):
            return replace(condition, part=grounded(part, binding))
        case AllOf(parts) | AnyOf(parts):
            return replace(condition, parts=tuple(grounded(part, binding) for part in parts))


def _fact(fact: FactRef, binding: Binding) -> FactRef:
    return FactRef(_name(fact.subject, binding), fact.attribute)


def _name(operand: Operand, binding: Binding) -> Operand:
    return Literal(binding[operand.name]) if isinstance(operand, Var) else operand


@dataclass(frozen=True, slots=True)
class Grounded:
    """A grounded condition and the declarations of its facts.

    Attributes:
        condition: without variables.
        facts: the declaration of each fact that it mentions.
        things: the sort of each thing whose sort is known.
    """

    condition: Condition
    facts: Mapping[str, FactDeclaration]
    things: Sorts


def ground_condition(
    repository: Repository, condition: Condition, binding: Binding, sorts: Sorts
) -> Grounded:
    """Grounds a condition; facts without a declaration are left out of its `facts`."""
    facts = {}
    for fact in facts_of(condition):
        declaration = declaration_of(repository, fact, sorts)
        if declaration is not None:
            facts[key_of(fact, binding)] = declaration
    things = {binding[name]: sort for name, sort in sorts.items() if name in binding}
    return Grounded(grounded(condition, binding), facts, things)


@dataclass(frozen=True, slots=True)
class NodeConditions:
    """The grounded conditions of one node.

    Attributes:
        edge: the precondition on its edge.
        when: its schema's own precondition.
        within: what must hold as long as anything of it runs.
        until: its postcondition.
    """

    edge: Grounded
    when: Grounded
    within: Grounded
    until: Grounded

    def __iter__(self) -> Iterator[Grounded]:
        """All four."""
        return iter((self.edge, self.when, self.within, self.until))


def conditions_of(repository: Repository, tree: Tree) -> list[NodeConditions]:
    """The grounded conditions of every node, in the order of the tree."""
    return [_conditions(repository, tree, node) for node in tree.nodes]


def _conditions(repository: Repository, tree: Tree, node: Node) -> NodeConditions:
    sorts, binding = sorts_of(node.schema), node.binding
    above = sorts_of(tree.nodes[node.parent].schema) if node.parent >= 0 else {}
    return NodeConditions(
        ground_condition(repository, node.edge, node.edge_binding, above),
        ground_condition(repository, node.schema.when, binding, sorts),
        ground_condition(repository, node.schema.within, binding, sorts),
        ground_condition(repository, node.schema.until, binding, sorts),
    )


def example_arguments(schema: Schema) -> tuple[str, ...]:
    """One thing for each parameter of a task, under the name of the parameter."""
    return tuple(param.name for param in schema.params)
