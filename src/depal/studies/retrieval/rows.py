"""What a study of retrieval says of one policy on one kind of pallet."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.studies.retrieval.runs import Retrieval
from depal.studies.statistics import Sample


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
        never: requests whose box was never free; they are left out of the means.
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
    policy: str,
    results: Sequence[Retrieval],
) -> Row:
    """The row of some requests."""
    done = [
        (each.actions, each.least)
        for each in results
        if each.actions is not None and each.least is not None
    ]
    return Row(
        pallets,
        side_only,
        clearance,
        policy,
        Sample.of([actions for actions, _ in done]),
        Sample.of([least for _, least in done]),
        Sample.of([actions - least for actions, least in done]),
        len(results) - len(done),
        sum(not each.proven for each in results),
    )
