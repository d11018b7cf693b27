"""Who may do what: roles, and who is asking."""

from dataclasses import dataclass
from enum import Enum


class Role(Enum):
    """What a person or a system may do (RELIABILITY: Security).

    A viewer sees; an operator also works with the cell; an integrator also sets it up; a service
    is a store's system: requests and events only.
    """

    VIEWER = "viewer"
    OPERATOR = "operator"
    INTEGRATOR = "integrator"
    SERVICE = "service"


ALL = frozenset(Role)
PEOPLE = frozenset({Role.VIEWER, Role.OPERATOR, Role.INTEGRATOR})
WORKERS = frozenset({Role.OPERATOR, Role.INTEGRATOR})
SET_UP = frozenset({Role.INTEGRATOR})
REQUESTERS = frozenset({Role.OPERATOR, Role.INTEGRATOR, Role.SERVICE})


@dataclass(frozen=True, slots=True)
class Principal:
    """Who is asking.

    Attributes:
        name: of the account.
        role: of the account.
        via: how they signed in: "session" or "token".
    """

    name: str
    role: Role
    via: str = "session"
