"""Every use case says who may use it; that is checked before anything else is looked at."""

import functools
import importlib
import inspect
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Concatenate, ParamSpec, TypeVar, cast

from depal.errors import DepalError, InputError
from depal.server.cell import Refusal
from depal.server.problems import (
    Answer,
    Conflict,
    Forbidden,
    SignInNeeded,
    TooMany,
    Unusable,
)
from depal.server.roles import Principal, Role
from depal.server.site import Site

P = ParamSpec("P")
T = TypeVar("T")

MARK = "use_case"

HIDDEN = "(not kept)"

LONG = 200
"""Of an argument so much is kept in the audit log [characters]."""


@dataclass(frozen=True, slots=True)
class UseCase:
    """A use case as others see it.

    Attributes:
        name: of the function.
        text: what it does, in a line.
        roles: who may; None for everybody, signed in or not.
        command: whether it changes something: then it is in the audit log.
    """

    name: str
    text: str
    roles: frozenset[Role] | None
    command: bool


Function = Callable[Concatenate[Site, Principal | None, P], T]


def use_case(
    roles: frozenset[Role] | None, *, command: bool = False, secrets: tuple[str, ...] = ()
) -> Callable[[Function[P, T]], Function[P, T]]:
    """Makes a use case of a function.

    Args:
        roles: who may use it; None for everybody.
        command: whether it changes something.
        secrets: arguments that the audit log must not see.

    Raises:
        SignInNeeded: from the function: nobody is signed in.
        Forbidden: from the function: the role may not.
    """

    def made(function: Function[P, T]) -> Function[P, T]:
        text = (function.__doc__ or "").strip().splitlines()[0]
        case = UseCase(function.__name__, text, roles, command)
        signature = inspect.signature(function)

        @functools.wraps(function)
        def called(site: Site, who: Principal | None, *args: P.args, **kwargs: P.kwargs) -> T:
            refused = _refused(case, who)
            if refused is not None:
                if command and who is not None:
                    site.audit.write(who, case.name, {}, str(refused))
                raise refused
            if not command:
                return _plainly(lambda: function(site, who, *args, **kwargs))
            bound = signature.bind(site, who, *args, **kwargs).arguments
            detail = {k: _told(k, v, secrets) for k, v in bound.items() if k not in {"site", "who"}}
            try:
                result = _plainly(lambda: function(site, who, *args, **kwargs))
            except TooMany:
                raise  # whoever hammers at the door does not fill the disk
            except DepalError as error:
                site.audit.write(who, case.name, detail, str(error)[:LONG])
                raise
            except Exception as error:
                site.audit.write(who, case.name, detail, f"a fault: {type(error).__name__}")
                raise
            site.audit.write(who, case.name, detail, "done")
            return result

        setattr(called, MARK, case)
        return cast("Function[P, T]", called)

    return made


def _refused(case: UseCase, who: Principal | None) -> Answer | None:
    if case.roles is None:
        return None
    if who is None:
        return SignInNeeded("sign in first")
    if who.role not in case.roles:
        names = ", ".join(sorted(role.value for role in case.roles))
        return Forbidden(f"{case.name} is for {names}; {who.name} is {who.role.value}")
    return None


def _plainly(do: Callable[[], T]) -> T:
    """What the product's own readers and the cell say becomes an answer."""
    try:
        return do()
    except Answer:
        raise
    except Refusal as refusal:
        raise Conflict(str(refusal)) from refusal
    except InputError as error:
        raise Unusable(str(error), error.problems) from error


def _told(name: str, value: object, secrets: tuple[str, ...]) -> object:
    if name in secrets:
        return HIDDEN
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    told = str(getattr(value, "value", value))
    return told if len(told) <= LONG else told[:LONG] + "..."


def use_cases() -> Mapping[str, UseCase]:
    """All of them, by name."""
    package = importlib.import_module("depal.server.usecases")
    found: dict[str, UseCase] = {}
    for module in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
        members: dict[str, Any] = vars(importlib.import_module(module.name))
        for member in members.values():
            case = getattr(member, MARK, None)
            if isinstance(case, UseCase):
                found[case.name] = case
    return dict(sorted(found.items()))
