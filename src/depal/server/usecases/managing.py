"""People, tokens, the audit log, signing in; and the runs of the past."""

from dataclasses import dataclass
from pathlib import Path

from depal import __version__
from depal.errors import Problem
from depal.server.people import AuditLine, PersonView, TokenView
from depal.server.problems import Conflict, Forbidden, NotFound, SignInNeeded, Unusable
from depal.server.records import RunView
from depal.server.roles import ALL, PEOPLE, SET_UP, Principal, Role
from depal.server.site import Site
from depal.server.usecases.registry import use_case

MOST = 500


@dataclass(frozen=True, slots=True)
class SignedIn:
    """Somebody who has signed in.

    Attributes:
        who: it is.
        secret: for the browser alone.
    """

    who: Principal
    secret: str


@dataclass(frozen=True, slots=True)
class NewToken:
    """A token with its secret, which nobody sees again."""

    token: TokenView
    secret: str


@dataclass(frozen=True, slots=True)
class Verified:
    """Whether the audit log is whole.

    Attributes:
        whole: whether it is.
        broken: the first line that is missing or was edited.
    """

    whole: bool
    broken: int | None


@dataclass(frozen=True, slots=True)
class Health:
    """That the server answers.

    Attributes:
        status: "ok".
        version: of depal.
    """

    status: str
    version: str


@use_case(None)
def see_health(site: Site, who: Principal | None) -> Health:
    """Whether the server answers, and which version it is."""
    del site, who
    return Health("ok", __version__)


@use_case(None, command=True, secrets=("code", "password"))
def make_first_account(
    site: Site, who: Principal | None, code: str, name: str, password: str, address: str = ""
) -> SignedIn:
    """Make the first account with the one-time code of the first start."""
    del who
    site.limits.attempt("", address)
    if site.accounts.any:
        raise Conflict("there are people already; ask an integrator")
    refusal = Forbidden("this code is good no longer; the cell prints a new one when it starts")
    if not site.codes.good(code):
        raise refusal
    site.accounts.check(name, Role.INTEGRATOR, password)
    if not site.codes.use(code):
        raise refusal
    person = site.accounts.add(name, Role.INTEGRATOR, password)
    site.limits.succeeded("", address)
    return SignedIn(Principal(person.name, person.role), site.sessions.open(person.name))


@use_case(None, command=True, secrets=("password",))
def sign_in(
    site: Site, who: Principal | None, name: str, password: str, address: str = ""
) -> SignedIn:
    """Sign in with a name and a password."""
    del who
    site.limits.attempt(name, address)
    person = site.accounts.matches(name, password)
    if person is None:
        raise SignInNeeded("this name and this password do not belong together")
    site.limits.succeeded(name, address)
    return SignedIn(Principal(person.name, person.role), site.sessions.open(person.name))


@use_case(PEOPLE, command=True, secrets=("secret",))
def sign_out(site: Site, who: Principal | None, secret: str) -> None:
    """Sign out."""
    del who
    site.sessions.close(secret)


@use_case(ALL)
def see_me(site: Site, who: Principal | None) -> Principal:
    """Who is asking."""
    del site
    if who is None:
        raise SignInNeeded("sign in first")
    return who


@use_case(SET_UP)
def list_people(site: Site, who: Principal | None) -> tuple[PersonView, ...]:
    """The accounts."""
    del who
    return site.accounts.list()


@use_case(SET_UP, command=True, secrets=("password",))
def add_person(
    site: Site, who: Principal | None, name: str, role: str, password: str
) -> PersonView:
    """Add a person."""
    del who
    return site.accounts.add(name, _role(role), password)


@use_case(SET_UP, command=True)
def change_person(
    site: Site, who: Principal | None, name: str, role: str, version: int | None = None
) -> PersonView:
    """Give a person another role."""
    del who
    return site.accounts.change(name, _role(role), version)


@use_case(SET_UP, command=True)
def remove_person(site: Site, who: Principal | None, name: str, version: int | None = None) -> None:
    """Remove a person."""
    del who
    site.accounts.remove(name, version)


@use_case(PEOPLE, command=True, secrets=("password",))
def set_password(site: Site, who: Principal | None, name: str, password: str) -> None:
    """Set a password: one's own, or as an integrator anybody's."""
    if who is None or (who.name != name and who.role is not Role.INTEGRATOR):
        raise Forbidden("only an integrator sets other people's passwords")
    site.accounts.set_password(name, password)


@use_case(SET_UP, command=True)
def add_token(site: Site, who: Principal | None, name: str, days: float) -> NewToken:
    """Make a token for a service; its secret is shown this once."""
    del who
    token, secret = site.tokens.add(name, days)
    return NewToken(token, secret)


@use_case(SET_UP)
def list_tokens(site: Site, who: Principal | None) -> tuple[TokenView, ...]:
    """The tokens of services, without their secrets."""
    del who
    return site.tokens.list()


@use_case(SET_UP, command=True)
def revoke_token(site: Site, who: Principal | None, token: str) -> TokenView:
    """A token is good no longer."""
    del who
    return site.tokens.revoke(token)


@use_case(SET_UP)
def read_audit(
    site: Site, who: Principal | None, after: int = 0, limit: int = 100
) -> tuple[AuditLine, ...]:
    """The audit log after a line."""
    del who
    return site.audit.list(max(after, 0), max(1, min(limit, MOST)))


@use_case(SET_UP)
def verify_audit(site: Site, who: Principal | None) -> Verified:
    """Whether the audit log is whole."""
    del who
    broken = site.audit.verify()
    return Verified(broken is None, broken)


@use_case(PEOPLE)
def list_runs(
    site: Site, who: Principal | None, before: int | None = None, limit: int = 50
) -> tuple[RunView, ...]:
    """The runs, the newest first."""
    del who
    return site.runs.list(before, max(1, min(limit, MOST)))


@use_case(PEOPLE)
def get_run(site: Site, who: Principal | None, number: int) -> RunView:
    """A run and what came of it."""
    del who
    return site.runs.get(number)


@use_case(PEOPLE)
def open_record(site: Site, who: Principal | None, number: int) -> Path:
    """The folder of a run's record, for who replays it."""
    del who
    site.runs.get(number)
    folder = site.folder / str(number)
    if not folder.is_dir():
        raise NotFound(f"run {number} has no record")
    return folder


def _role(name: str) -> Role:
    known = sorted(role.value for role in PEOPLE)
    if name not in known:
        problem = Problem("role", f"{name[:20]!r}", ", ".join(known))
        raise Unusable("no such role", [problem])
    return Role(name)
