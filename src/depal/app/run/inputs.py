"""What a run is given, checked before anything moves."""

from collections.abc import Sequence

from depal.cell.checking.delivery import check_delivery_against_cell
from depal.cell.checking.findings import CellFinding, Weight
from depal.cell.files import find_cell
from depal.cell.workplace import Policy
from depal.domain import CellLayout, Delivery
from depal.errors import CellError, SettingError, did_you_mean


def cell_of(reference: str) -> CellLayout:
    """The cell of a file or of a name that ships.

    Raises:
        CellError: there is none, or it cannot be used.
    """
    return find_cell(reference)


def one_of(option: str, name: str, known: Sequence[str]) -> str:
    """A name out of those that there are.

    Raises:
        SettingError: there is none of that name.
    """
    if name not in known:
        exists = did_you_mean(name, known)
        raise SettingError(option, f"unknown {option.lstrip('-')} {name!r}", exists=exists)
    return name


def policy_of(name: str) -> Policy:
    """The policy of that name.

    Raises:
        SettingError: there is none.
    """
    return Policy(one_of("--policy", name, [policy.value for policy in Policy]))


def checked_speed(speed: float) -> float:
    """A share of the arm's full speed.

    Raises:
        SettingError: it is not in (0, 1].
    """
    if not 0.0 < speed <= 1.0:
        raise SettingError("--speed", f"{speed!r} is out of range", "a number in (0, 1]")
    return speed


def refuse_what_cannot_work(layout: CellLayout, delivery: Delivery) -> tuple[CellFinding, ...]:
    """Whether this cell can take this delivery.

    Returns:
        What is to be said before anything moves: products that the arm cannot handle. Their cases
        are left for a person, with the reason.

    Raises:
        CellError: the delivery comes on a pallet that does not fit.
    """
    findings = check_delivery_against_cell(layout, delivery)
    wrong = [
        f.problem for f in findings if f.weight is Weight.ERROR and f.problem.where == "pallet"
    ]
    if wrong:
        raise CellError(f"delivery {delivery.id} in cell {layout.name}", wrong)
    return findings
