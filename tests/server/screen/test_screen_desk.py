"""A desk asks the use cases as whoever is signed in now, and nothing is done twice."""

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from argon2 import PasswordHasher
from browsing import DELIVERY
from served import site_in

from depal.server.cell import Settings
from depal.server.cellstate import CellState, Mode
from depal.server.problems import (
    Conflict,
    Forbidden,
    NotFound,
    SignInNeeded,
    Stale,
    Unusable,
    WrongType,
)
from depal.server.roles import Role
from depal.server.screen.desk import Desk, desk_for
from depal.server.site import Site

PASSWORD = "ten letters at least"  # noqa: S105 - of nobody

QUICK = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)


@pytest.fixture
def site(tmp_path: Path) -> Iterator[Site]:
    """A site over a cell that plays a run."""
    site = site_in(tmp_path, 0.0, QUICK)
    for role, name in ((Role.VIEWER, "vera"), (Role.OPERATOR, "otto"), (Role.INTEGRATOR, "ines")):
        site.accounts.add(name, role, PASSWORD)
    yield site
    site.store.database.close()


def desk(site: Site, name: str) -> Desk:
    """Of somebody who has just signed in."""
    return desk_for(site, site.sessions.open(name))


def test_nobody_has_no_desk(site: Site) -> None:
    """Nobody has no desk."""
    for secret in (None, "", "made up"):
        with pytest.raises(SignInNeeded):
            desk_for(site, secret)


def test_who_has_signed_out_can_do_nothing_at_an_open_desk(site: Site) -> None:
    """Who has signed out can do nothing at an open desk."""
    open_desk = desk(site, "otto")
    site.sessions.close(open_desk.secret)
    assert open_desk.me() is None
    for command in (open_desk.hold, open_desk.sample, open_desk.deliveries, open_desk.picture):
        with pytest.raises(SignInNeeded):
            command()


def test_who_was_given_another_role_signs_in_anew(site: Site) -> None:
    """Who was given another role signs in anew."""
    open_desk = desk(site, "otto")
    site.accounts.change("otto", Role.VIEWER)
    with pytest.raises(SignInNeeded):
        open_desk.sample()
    with pytest.raises(Forbidden):
        desk(site, "otto").sample()


def test_a_viewer_sees_and_does_nothing(site: Site) -> None:
    """A viewer sees and does nothing."""
    vera = desk(site, "vera")
    assert vera.deliveries() == []
    assert vera.products() == []
    for command in (vera.sample, vera.hold, vera.resume, vera.stop_after_box, vera.people):
        with pytest.raises(Forbidden):
            command()


def test_a_delivery_is_uploaded_moved_and_taken_out(site: Site) -> None:
    """A delivery is uploaded, moved and taken out."""
    otto = desk(site, "otto")
    otto.upload("tuesday.json", DELIVERY.read_bytes())
    otto.sample()
    first, second = otto.deliveries()
    otto.move_delivery(second.id, 1, second.version)
    assert [each.id for each in otto.deliveries()] == [second.id, first.id]
    with pytest.raises(Stale):
        otto.cancel_delivery(second.id, second.version)
    otto.cancel_delivery(first.id, first.version)
    assert [each.id for each in otto.deliveries()] == [second.id]


def test_every_sample_is_another_one(site: Site) -> None:
    """Every sample is another one."""
    otto = desk(site, "otto")
    otto.sample()
    otto.sample()
    names = [each.id for each in otto.deliveries()]
    assert len(set(names)) == 2


@pytest.mark.parametrize("content", [b"", b"\xff\xfe\x00", b"[]", b"{", b"\x00" * 50])
def test_what_is_no_delivery_is_refused_with_a_reason(site: Site, content: bytes) -> None:
    """What is no delivery is refused with a reason."""
    with pytest.raises(Unusable) as refusal:
        desk(site, "otto").upload("file.json", content)
    assert str(refusal.value)


def test_a_product_keeps_its_picture_and_a_page_is_none(site: Site) -> None:
    """A product keeps its picture, and a page is none."""
    ines = desk(site, "ines")
    ines.upload("tuesday.json", DELIVERY.read_bytes())
    gtin = ines.products()[0].gtin
    assert ines.product_picture(gtin) == b""
    picture = b"\x89PNG\r\n\x1a\n" + b"\x00" * 20
    ines.put_picture(gtin, picture)
    assert ines.product_picture(gtin) == picture
    with pytest.raises(WrongType):
        ines.put_picture(gtin, b"<svg onload=alert(1)>")


def test_settings_that_somebody_has_changed_meanwhile_are_not_overwritten(site: Site) -> None:
    """Settings that somebody has changed meanwhile are not overwritten."""
    ines = desk(site, "ines")
    _, version = ines.settings()
    ines.put_settings(Settings(0.8, 0.5, "access"), version)
    with pytest.raises(Stale):
        ines.put_settings(Settings(0.1, 1.0, "paper"), version)
    assert ines.settings()[0] == Settings(0.8, 0.5, "access")


def test_two_people_who_answer_one_question_answer_it_once(site: Site) -> None:
    """Two people who answer one question answer it once, and the second is told by whom."""
    otto, ines = desk(site, "otto"), desk(site, "ines")
    otto.upload("tuesday.json", DELIVERY.read_bytes())
    asked = waited(site, lambda: otto.start("tuesday-01"))
    question = asked.questions[0]
    otto.answer(question.id, "taken")
    with pytest.raises(Conflict, match="otto has answered this question already: taken"):
        ines.answer(question.id, "it is not there")


def test_a_request_that_is_sent_twice_is_one(site: Site) -> None:
    """A request that is sent twice is one, and what is due stays so when it is changed."""
    otto = desk(site, "otto")
    otto.upload("tuesday.json", DELIVERY.read_bytes())
    gtin = otto.products()[0].gtin
    due = site.chance.now() + 1800.0
    for _ in range(2):
        otto.add_request(gtin, None, 0.3, due, "once")
    (kept,) = site.requests.list()
    otto.change_request(kept.key, 0.9)
    (changed,) = site.requests.list()
    assert (changed.priority, changed.due) == (0.9, kept.due)
    otto.cancel_request(kept.key)
    with pytest.raises(Conflict):
        otto.change_request(kept.key, 0.1)
    with pytest.raises(NotFound):
        otto.change_request("r-unknown", 0.1)


def waited(site: Site, begin: Callable[[], None]) -> CellState:
    """The first state with a question in it."""
    asked = threading.Event()
    end = site.cell.watch(lambda state: asked.set() if state.questions else None)
    begin()
    assert asked.wait(30)
    end()
    state = site.cell.state()
    assert state.mode is Mode.HELD
    return state
