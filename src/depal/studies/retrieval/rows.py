"""What a study of retrieval says of one policy on one kind of pallet."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.studies.retrieval.runs import Retrieval
from depal.studies.statistics import Sample

POLICIES = ("paper", "access")


@dataclass(frozen=True, slots=True)
class Row:
    """One policy on one kind of pallet.

    Attributes:
        pallets: the generator's name, or "real".
        side_only: the share of boxes that only a side grasp can take.
        clearance: whether the tool's clearance and the arm's reach count.
        policy: "paper" or "access".
        actions: boxes stored before the requested one.
        limit: the proven minimum under the same rule of what blocks what.
        gap: actions less the minimum, request by request.
        never: requests whose box was never free. What one policy never reached is left out of
            the means of both.
        unproven: requests whose plan may not be the smallest.
    """

    pallets: str
    side_only: float
    clearance: bool
    policy: str
    actions: Sample
    limit: Sample
    gap: Sample
    never: int
    unproven: int


def row_of(
    pallets: str,
    side_only: float,
    clearance: bool,  # noqa: FBT001 - a field of the row
    pairs: Sequence[tuple[Retrieval, Retrieval]],
    policy: int,
) -> Row:
    """The row of one policy.

    Args:
        pallets: the generator's name, or "real".
        side_only: the share of boxes that only a side grasp can take.
        clearance: whether the tool's clearance and the arm's reach count.
        pairs: per request the results of the policies, in the order of POLICIES.
        policy: its place in POLICIES.
    """
    results = [pair[policy] for pair in pairs]
    done = [
        (each.actions, each.least)
        for each, pair in zip(results, pairs, strict=True)
        if each.actions is not None
        and each.least is not None
        and all(other.actions is not None for other in pair)
    ]
    return Row(
        pallets,
        side_only,
        clearance,
        POLICIES[policy],
        Sample.of([actions for actions, _ in done]),
        Sample.of([least for _, least in done]),
        Sample.of([actions - least for actions, least in done]),
        sum(each.actions is None for each in results),
        sum(not each.proven for each in results),
    )
