"""Asking twice, asking at once, asking again after a crash; due times over clocks."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sites import DELIVERY, LINE, Held, site_over

from depal.domain import Gtin, Request
from depal.logistics.store import Database
from depal.server.cell import Order, Refusal
from depal.server.cellstate import CellState, Mode
from depal.server.problems import Conflict, NotFound, Stale, Unusable
from depal.server.records import Requests
from depal.server.roles import Principal, Role
from depal.server.site import Site
from depal.server.usecases import deliveries, wanting, working

OTTO, INES = Principal("otto", Role.OPERATOR), Principal("ines", Role.INTEGRATOR)

GTIN = LINE.product.gtin


@pytest.fixture
def site(tmp_path: Path) -> Site:
    """Busy, with people."""
    return site_over(tmp_path)


@pytest.fixture
def idle(site: Site) -> Site:
    """Nothing on the pallet; d-1 and d-2 wait."""
    site.runs.end(1, "done", {})
    told(site, CellState())
    return site


def told(site: Site, state: CellState) -> None:
    """The cell says something else."""
    site.cell.tell(state)  # type: ignore[attr-defined]


def wait(site: Site, seconds: float) -> None:
    """Time goes on."""
    site.chance.time += seconds  # type: ignore[attr-defined]


def at_once(*work: Callable[[], object]) -> list[object]:
    """What came of several calls from several threads."""

    def outcome(call: Callable[[], object]) -> object:
        try:
            return call()
        except Conflict as conflict:
            return conflict

    with ThreadPoolExecutor(len(work)) as pool:
        return list(pool.map(outcome, work))


def test_the_same_key_asks_once_however_late_the_due_time_is_counted_from(site: Site) -> None:
    """`due_in` counts from the first time."""
    first = wanting.add_request(site, OTTO, gtin=GTIN, due_in=300.0, repeat="k")
    wait(site, 7.0)
    again = wanting.add_request(site, OTTO, gtin=GTIN, due_in=300.0, repeat="k")
    assert again == first
    with pytest.raises(Unusable, match="used for something else"):
        wanting.add_request(site, OTTO, gtin=GTIN, due_in=301.0, repeat="k")
    other = wanting.add_request(site, INES, gtin=GTIN, due_in=301.0, repeat="k")
    assert other.key != first.key


def test_the_same_key_at_once_is_one_request_of_store_and_cell(site: Site) -> None:
    """Eight threads with one key."""

    def ask() -> str:
        return wanting.add_request(site, OTTO, gtin=GTIN, repeat="k").key

    keys = at_once(*[ask] * 8)
    assert len(set(keys)) == 1
    assert [view.key for view in site.requests.list()] == ["r-1", *set(keys)]
    assert [line.key for line in site.cell.state().requests] == [*set(keys)]


def test_a_key_is_answered_though_the_same_could_not_be_asked_now(site: Site) -> None:
    """The box has been stored meanwhile: the first answer still holds."""
    first = wanting.add_request(site, OTTO, box="b1", repeat="k")
    told(site, replace(site.cell.state(), queue=()))
    assert wanting.add_request(site, OTTO, box="b1", repeat="k").key == first.key


def test_a_key_whose_request_was_never_written_makes_it_now(site: Site) -> None:
    """The server ended between the two."""
    body = {"gtin": GTIN, "box": None, "priority": 0.5, "due": None, "due_in": None}
    site.repeats.claim("otto", "k", body, "r-promised")
    assert wanting.add_request(site, OTTO, gtin=GTIN, repeat="k").key == "r-promised"


def test_what_the_cell_refuses_may_be_asked_again_with_its_key(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The refused request has ended; the next one is another."""

    def refuse(key: str, request: Request) -> None:
        raise Refusal(f"not now: {key} for {request.wanted}")

    with monkeypatch.context() as broken:
        broken.setattr(site.cell, "add_request", refuse)
        with pytest.raises(Conflict, match="not now"):
            wanting.add_request(site, OTTO, gtin=GTIN, repeat="k")
    assert site.requests.list()[-1].state == "rejected"
    assert wanting.add_request(site, OTTO, gtin=GTIN, repeat="k").state == "pending"


def test_what_is_not_named_in_a_change_stays(site: Site) -> None:
    """Another priority keeps the due time, also one that has passed."""
    made = wanting.add_request(site, OTTO, gtin=GTIN, due_in=60.0)
    wait(site, 3600.0)
    changed = wanting.change_request(site, OTTO, made.key, priority=0.9, keep_due=True)
    assert (changed.priority, changed.due) == (0.9, made.due)
    later = wanting.change_request(site, OTTO, made.key, due_in=60.0)
    assert (later.priority, later.due) == (0.9, site.chance.now() + 60.0)
    assert wanting.change_request(site, OTTO, made.key).due is None
    with pytest.raises(Stale):
        wanting.change_request(site, OTTO, made.key, version=1, priority=0.1)


@given(
    came=st.floats(0.0, 1e6),
    ahead=st.none() | st.floats(0.0, 1e5),
    passed=st.floats(0.0, 1e5),
    now=st.floats(0.0, 1e6),
)
def test_a_request_is_due_in_the_same_time_whatever_the_clock_of_the_run(
    came: float, ahead: float | None, passed: float, now: float
) -> None:
    """It waits for the next pallet, which may come after a restart: its clock begins anew."""
    chance = Held()
    requests = Requests(Database(), chance)
    due = None if ahead is None else chance.now() + ahead
    clock = None if ahead is None else came + ahead
    wish = Request(0.5, gtin=Gtin(GTIN), arrived=came, due=clock)
    requests.add("r", wish, by="x", run=None, due=due)
    chance.time += passed
    ((key, found),) = requests.waiting(7, now)
    assert key == "r"
    assert found.arrived <= now
    if ahead is None:
        assert found.due is None
    else:
        expected = max(now + ahead - passed, found.arrived)
        assert found.due == pytest.approx(expected, abs=1e-5)


def test_a_box_is_wanted_of_its_own_pallet_alone_and_ends_with_it(site: Site) -> None:
    """A product waits for the next delivery; nothing stays pending for ever (I8)."""
    box = wanting.add_request(site, OTTO, box="b1")
    product = wanting.add_request(site, OTTO, gtin=GTIN)
    assert [key for key, _ in site.requests.waiting(1, 0.0)] == ["r-1", box.key, product.key]
    assert [key for key, _ in site.requests.waiting(2, 0.0)] == [product.key]
    site.runs.end(1, "aborted", {}, 12.0)
    assert site.requests.get(box.key).state == "rejected"
    assert site.requests.get("r-1").state == "rejected"
    assert site.requests.get(product.key).state == "pending"


def test_of_two_who_press_start_at_once_one_begins_one_run(idle: Site) -> None:
    """Whether they mean the same delivery or each the next one."""

    def press() -> object:
        return working.start(idle, OTTO).run

    came = at_once(*[press] * 4)
    assert came.count(2) >= 1
    assert all(each == 2 or isinstance(each, Conflict) for each in came)
    assert [run.number for run in idle.runs.list()] == [2, 1]
    states = {view.id: view.state for view in idle.queue.list()}
    assert states == {"d-0": "done", "d-1": "running", "d-2": "queued"}


def test_what_cannot_be_begun_waits_again(idle: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    """The run has failed, and the delivery is the next one still."""

    def refuse(order: Order | None = None) -> None:
        raise Refusal(f"no world for {order}")

    with monkeypatch.context() as broken:
        broken.setattr(idle.cell, "start", refuse)
        with pytest.raises(Conflict, match="no world"):
            working.start(idle, OTTO, "d-2")
    assert idle.runs.get(2).state == "failed"
    assert idle.queue.get("d-2")[0].state == "queued"
    assert working.start(idle, OTTO, "d-2").mode is Mode.EXECUTE


def test_a_request_that_comes_while_a_run_begins_is_told_to_the_cell(
    idle: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After the order was made, before the cell had it: the cell knew of no run to add it to."""
    begin = idle.cell.start

    def slowly(order: Order | None = None) -> None:
        idle.requests.add("r-late", Request(0.5, gtin=Gtin(GTIN)), by="x", run=None, due=None)
        begin(order)

    monkeypatch.setattr(idle.cell, "start", slowly)
    working.start(idle, OTTO)
    assert [line.key for line in idle.cell.state().requests] == ["r-late"]


def test_a_file_of_deliveries_is_added_whole_or_not_at_all(idle: Site) -> None:
    """One name is taken: the others are not added either."""
    many = [replace(DELIVERY, id=name) for name in ("n-1", "n-2", "d-2")]
    with pytest.raises(Conflict, match="'d-2' already"):
        idle.queue.add_all(many, "otto")
    assert idle.queue.known(["n-1", "n-2", "d-2"]) == {"d-2"}


def test_pages_of_a_list_are_the_list(idle: Site) -> None:
    """Deliveries, requests and questions: each once, in order, whatever the size of a page."""
    for number in range(5):
        wanting.add_request(idle, OTTO, gtin=GTIN, priority=number / 10)
    every = wanting.list_requests(idle, OTTO)
    pages, after = [], 0
    while page := wanting.list_requests(idle, OTTO, after=after, limit=2):
        pages += page
        after = page[-1].number
    assert tuple(pages) == every
    whole, names = deliveries.list_deliveries(idle, OTTO), []
    last: str | None = None
    while part := deliveries.list_deliveries(idle, OTTO, after=last, limit=2):
        names += [view.id for view in part]
        last = part[-1].id
    assert names == [view.id for view in whole] == ["d-1", "d-2", "d-0"]
    (question,) = wanting.list_questions(idle, OTTO)
    assert wanting.list_questions(idle, OTTO, before=question.id) == ()
    with pytest.raises(NotFound):
        wanting.list_questions(idle, OTTO, before="nothing")
