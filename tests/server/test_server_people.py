"""Accounts, sessions, tokens, codes, and the audit log, over time."""

import sqlite3
import threading
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sites import PASSWORD, PEOPLE, Held, site_over

from depal.server.people import accounts
from depal.server.people.codes import LASTS
from depal.server.people.limits import FREE, LONGEST, Limits
from depal.server.people.sessions import IDLE
from depal.server.people.sessions import LONGEST as SESSION
from depal.server.problems import (
    Conflict,
    Forbidden,
    NotFound,
    SignInNeeded,
    Stale,
    TooMany,
    Unusable,
)
from depal.server.roles import Principal, Role
from depal.server.site import Site
from depal.server.usecases import managing

INES = Principal("ines", Role.INTEGRATOR)


@pytest.fixture
def site(tmp_path: Path) -> Site:
    """With people, and nothing else."""
    return site_over(tmp_path, busy=False)


def wait(site: Site, seconds: float) -> None:
    """Time goes on, or back."""
    site.chance.time += seconds  # type: ignore[attr-defined]


def test_a_password_is_kept_as_a_hash_and_a_secret_as_a_digest(site: Site, tmp_path: Path) -> None:
    """Who reads the database can sign in nowhere."""
    session = site.sessions.open("vera")
    _, token = site.tokens.add("till", 10.0)
    code = site.codes.make()
    with closing(sqlite3.connect(tmp_path / "store.db")) as connection:
        dump = "\n".join(connection.iterdump())
    assert "$argon2id$" in dump
    for secret in (PASSWORD, session, token, code):
        assert secret not in dump


def test_a_session_ends_after_a_time_without_use_and_after_a_time_in_any_case(site: Site) -> None:
    """Use keeps it open, but not for ever; signing out ends it at once."""
    secret = site.sessions.open("vera")
    for _ in range(int(SESSION // (IDLE / 2))):
        assert site.sessions.who(secret) == Principal("vera", Role.VIEWER)
        wait(site, IDLE / 2)
    wait(site, IDLE / 2)
    assert site.sessions.who(secret) is None
    idle = site.sessions.open("vera")
    wait(site, IDLE + 1)
    assert site.sessions.who(idle) is None
    out = site.sessions.open("vera")
    site.sessions.close(out)
    assert site.sessions.who(out) is None


def test_another_role_password_or_nobody_ends_the_sessions(site: Site) -> None:
    """What somebody was allowed before counts no longer."""
    for change in (
        lambda: site.accounts.change("otto", Role.VIEWER),
        lambda: site.accounts.set_password("otto", "another one, longer"),
        lambda: site.accounts.remove("otto"),
    ):
        secret = site.sessions.open("otto")
        change()
        assert site.sessions.who(secret) is None


def test_the_last_integrator_stays(site: Site) -> None:
    """Otherwise nobody could set anything up again."""
    with pytest.raises(Conflict, match="last integrator"):
        site.accounts.remove("ines")
    with pytest.raises(Conflict, match="last integrator"):
        site.accounts.change("ines", Role.VIEWER)
    site.accounts.add("ivo", Role.INTEGRATOR, PASSWORD)
    site.accounts.remove("ines")
    assert [person.name for person in site.accounts.list()] == ["ivo", "otto", "vera"]


@pytest.mark.parametrize(
    ("name", "role", "password", "wrong"),
    [
        ("", Role.VIEWER, PASSWORD, "name"),
        ("a\nb", Role.VIEWER, PASSWORD, "name"),
        ("x" * 41, Role.VIEWER, PASSWORD, "name"),
        ("a/b", Role.VIEWER, PASSWORD, "name"),
        ("..", Role.VIEWER, PASSWORD, "name"),
        ("x", Role.SERVICE, PASSWORD, "role"),
        ("x", Role.VIEWER, "short", "password"),
        ("x", Role.VIEWER, "y" * 201, "password"),
    ],
)
def test_an_account_that_cannot_be_used_is_not_made(
    site: Site, name: str, role: Role, password: str, wrong: str
) -> None:
    """With what is wrong."""
    with pytest.raises(Unusable) as caught:
        site.accounts.add(name, role, password)
    assert [problem.where for problem in caught.value.problems] == [wrong]
    assert {person.name for person in site.accounts.list()} == set(PEOPLE.values())


def test_a_one_time_code_makes_one_account_within_its_time(tmp_path: Path) -> None:
    """A bad account does not use it up; a new code makes the old one useless."""
    site = site_over(tmp_path, busy=False)
    for name in PEOPLE.values():
        if name != "ines":
            site.accounts.remove(name)
    with pytest.raises(Conflict, match="there are people"):
        managing.make_first_account(site, None, site.codes.make(), "x", PASSWORD)
    old, code = site.codes.make(), site.codes.make()
    assert not site.codes.good(old)
    assert site.codes.good(code)
    wait(site, LASTS)
    assert not site.codes.use(code)
    fresh = site.codes.make()
    assert site.codes.use(fresh)
    assert not site.codes.use(fresh)


def test_a_token_is_good_until_it_expires_or_is_revoked(site: Site) -> None:
    """And acts as a service, whatever it is called."""
    view, secret = site.tokens.add("till", 2.0)
    assert site.tokens.who(secret) == Principal("service till", Role.SERVICE, via="token")
    site.tokens.revoke(view.id)
    assert site.tokens.who(secret) is None
    _, other = site.tokens.add("till", 2.0)
    wait(site, 2 * 86400.0)
    assert site.tokens.who(other) is None
    with pytest.raises(NotFound):
        site.tokens.revoke("nothing")
    with pytest.raises(Unusable):
        site.tokens.add("till", 0.0)


def told_to_wait(limits: Limits) -> float:
    """How long a try has to wait [s]; 0 where it is allowed."""
    try:
        limits.attempt("anna", "1.2.3.4")
    except TooMany as answer:
        return answer.after or 0.0
    return 0.0


@given(st.lists(st.floats(-4000.0, 4000.0), max_size=30))
def test_whatever_the_clock_does_nobody_waits_longer_than_the_limit(jumps: list[float]) -> None:
    """After the wait that it is told, a try is allowed."""
    chance = Held()
    limits = Limits(chance)
    for jump in jumps:
        chance.time += jump
        wait = told_to_wait(limits)
        assert 0.0 <= wait <= LONGEST
        chance.time += wait
        if wait > 0.0:
            limits.attempt("anna", "1.2.3.4")


def test_an_address_that_guesses_many_names_has_to_wait_too() -> None:
    """Each name fails once, and the address is known."""
    limits = Limits(Held())
    for number in range(FREE["address"]):
        limits.attempt(f"name {number}", "1.2.3.4")
    with pytest.raises(TooMany):
        limits.attempt("a new name", "1.2.3.4")
    limits.attempt("a new name", "5.6.7.8")


def test_every_command_is_in_the_log_without_secrets(site: Site) -> None:
    """Who, what, with what, and what came of it; refusals too."""
    managing.add_person(site, INES, "new", "viewer", PASSWORD)
    with pytest.raises(Conflict):
        managing.add_person(site, INES, "new", "viewer", PASSWORD)
    with pytest.raises(Forbidden):
        managing.add_person(site, Principal("vera", Role.VIEWER), "other", "viewer", PASSWORD)
    lines = site.audit.list()
    assert [(line.who, line.what, line.outcome[:8]) for line in lines] == [
        ("ines", "add_person", "done"),
        ("ines", "add_person", "there is"),
        ("vera", "add_person", "add_pers"),
    ]
    assert not any(PASSWORD in line.detail for line in lines)
    assert '"name": "new"' in lines[0].detail


def test_tries_at_once_are_as_many_as_one_after_the_other() -> None:
    """Each counts before its password is looked at; the right one takes its own count back."""
    limits = Limits(Held())
    for _ in range(FREE["account"]):
        limits.attempt("anna", "1.2.3.4")
    with pytest.raises(TooMany):
        limits.attempt("anna", "9.9.9.9")
    for number in range(3 * FREE["address"]):
        limits.attempt(f"good {number}", "5.6.7.8")
        limits.succeeded(f"good {number}", "5.6.7.8")


def test_passwords_are_checked_two_at_a_time(site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each takes 64 MB, and the controller runs on the same machine."""
    monkeypatch.setattr(accounts, "PATIENCE", 0.0)
    busy = threading.BoundedSemaphore(accounts.AT_ONCE)
    monkeypatch.setattr(site.accounts, "_turns", busy)
    with busy:
        assert site.accounts.matches("vera", PASSWORD) is not None
        with busy, pytest.raises(TooMany):
            site.accounts.matches("vera", PASSWORD)
    assert site.accounts.matches("vera", "wrong, and long") is None


def test_who_is_told_to_wait_does_not_fill_the_audit_log(site: Site) -> None:
    """The failures that led to it are there, and nothing more."""
    for _ in range(FREE["account"]):
        with pytest.raises(SignInNeeded):
            managing.sign_in(site, None, "vera", "wrong, and long", "1.2.3.4")
    for _ in range(50):
        with pytest.raises(TooMany):
            managing.sign_in(site, None, "vera", PASSWORD, "1.2.3.4")
    assert len(site.audit.list()) == FREE["account"]


def test_guessing_the_first_code_gets_slower_too(tmp_path: Path) -> None:
    """By address; anybody may ask for it."""
    site = site_over(tmp_path, busy=False)
    for _ in range(FREE["address"]):
        with pytest.raises(Conflict):
            managing.make_first_account(site, None, "guess", "x", PASSWORD, "1.2.3.4")
    with pytest.raises(TooMany):
        managing.make_first_account(site, None, "guess", "x", PASSWORD, "1.2.3.4")


def test_of_two_who_change_a_person_the_second_sees_what_the_first_did(site: Site) -> None:
    """By the version that each has seen."""
    changed = site.accounts.change("otto", Role.VIEWER, 1)
    assert changed.version == 2
    with pytest.raises(Stale):
        site.accounts.change("otto", Role.INTEGRATOR, 1)
    with pytest.raises(Stale):
        site.accounts.remove("otto", 1)
    site.accounts.remove("otto", 2)


@pytest.mark.parametrize(
    ("edit", "broken"),
    [
        ("UPDATE audit SET outcome = 'never' WHERE number = 2", 2),
        ("UPDATE audit SET at = at + 1 WHERE number = 1", 1),
        ("DELETE FROM audit WHERE number = 2", 2),
        ("UPDATE audit SET seal = 'x' WHERE number = 3", 3),
    ],
)
def test_an_edited_log_is_found_out(site: Site, tmp_path: Path, edit: str, broken: int) -> None:
    """The first line that is not as it was written."""
    for number in range(4):
        site.audit.write(INES, "start", {"number": number}, "done")
    assert site.audit.verify() is None
    with closing(sqlite3.connect(tmp_path / "store.db")) as connection:
        connection.execute(edit)
        connection.commit()
    assert site.audit.verify() == broken
