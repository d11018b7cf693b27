"""Requests and questions: what the store wants, and what the cell wants to know."""

import hashlib
import math

from depal.domain import BoxId, Gtin, Request
from depal.errors import DepalError, Problem, did_you_mean
from depal.logistics.store import RequestState
from depal.server.problems import Conflict, NotFound, Unusable
from depal.server.records import QuestionView, RequestView
from depal.server.roles import PEOPLE, REQUESTERS, WORKERS, Principal
from depal.server.site import Site
from depal.server.usecases.registry import use_case

FARTHEST = 30 * 86400.0
"""A due time may lie so far ahead [s]."""

MOST = 500


@use_case(REQUESTERS, command=True)
def add_request(
    site: Site,
    who: Principal | None,
    *,
    gtin: str | None = None,
    box: str | None = None,
    priority: float = 0.5,
    due: float | None = None,
    repeat: str | None = None,
) -> RequestView:
    """Ask for a product or a box; the same Idempotency-Key asks once."""
    name = "nobody" if who is None else who.name
    body = {"gtin": gtin, "box": box, "priority": priority, "due": due}
    key = f"r-{site.chance.secret(9)}"
    if repeat is not None:
        known = site.repeats.seen(name, repeat, body)
        if known is not None:
            return site.requests.get(known)
        key = "r-" + hashlib.sha256(f"{name}\n{repeat}".encode()).hexdigest()[:16]
    state = site.cell.state()
    clock_due = _checked_due(site, due, state.at)
    run = _of_a_box(site, box) if box is not None else None
    if gtin is not None and box is None:
        _of_a_product(site, gtin)
    request = Request(
        priority,
        gtin=None if gtin is None else Gtin(gtin),
        box=None if box is None else BoxId(box),
        arrived=state.at,
        due=clock_due,
    )
    if repeat is not None:
        site.repeats.keep(name, repeat, body, key)
    view = site.requests.add(key, request, by=name, run=run, due=due)
    try:
        site.cell.add_request(key, request)
    except DepalError as error:
        site.requests.end(key, served=False, at=state.at, reason=str(error))
        raise
    return view


def _of_a_product(site: Site, gtin: str) -> None:
    if site.store.product(Gtin(gtin)) is None:
        known = [product.gtin for product in site.store.products("", "", MOST)]
        raise NotFound(f"the store knows no product {gtin[:40]!r}; {did_you_mean(gtin, known)}")


def _of_a_box(site: Site, box: str) -> int:
    state = site.cell.state()
    if state.run is None:
        raise Conflict("no pallet is worked on, so no box can be asked for")
    standing = {each.box: each.place for each in state.standing}
    if box in standing:
        raise Conflict(f"box {box!r} is stored already: it stands in {standing[box]}")
    known = [line.box for line in state.queue]
    if box not in known:
        raise NotFound(f"no box {box[:40]!r} stands on the pallet; {did_you_mean(box, known)}")
    return state.run


def _checked_due(site: Site, due: float | None, at: float) -> float | None:
    """A due time on the cell's clock."""
    if due is None:
        return None
    ahead = due - site.chance.now()
    if not (math.isfinite(ahead) and 0.0 <= ahead <= FARTHEST):
        expected = f"a time in the next {FARTHEST / 86400:.0f} days"
        raise Unusable("this request cannot be used", [Problem("due", f"{due!r}", expected)])
    return at + ahead


@use_case(REQUESTERS | PEOPLE)
def list_requests(
    site: Site, who: Principal | None, state: str | None = None, after: int = 0, limit: int = 100
) -> tuple[RequestView, ...]:
    """The requests in the order in which they came."""
    del who
    wanted = () if state is None else (_state(state),)
    return site.requests.list(*wanted, after=after, limit=max(1, min(limit, MOST)))


def _state(name: str) -> RequestState:
    known = [state.value for state in RequestState]
    if name not in known:
        problem = Problem("state", f"{name[:20]!r}", ", ".join(known))
        raise Unusable("no such state", [problem])
    return RequestState(name)


@use_case(REQUESTERS | PEOPLE)
def get_request(site: Site, who: Principal | None, key: str) -> RequestView:
    """A request and what became of it."""
    del who
    return site.requests.get(key)


@use_case(REQUESTERS, command=True)
def change_request(
    site: Site,
    who: Principal | None,
    key: str,
    *,
    version: int,
    priority: float,
    due: float | None = None,
) -> RequestView:
    """Change the priority or the due time of a request."""
    del who
    if not 0.0 <= priority <= 1.0:
        problem = Problem("priority", f"{priority!r} is out of range", "a number in [0, 1]")
        raise Unusable("this request cannot be used", [problem])
    clock_due = _checked_due(site, due, site.cell.state().at)
    request = site.requests.change(key, version, priority, (clock_due, due))
    site.cell.change_request(key, request)
    return site.requests.get(key)


@use_case(REQUESTERS, command=True)
def cancel_request(
    site: Site, who: Principal | None, key: str, version: int | None = None
) -> RequestView:
    """A request is not wanted any more."""
    before = site.requests.get(key)
    if before.state == RequestState.PENDING.value and (version in {None, before.version}):
        site.cell.cancel_request(key)  # a case that serves it already keeps it
    return site.requests.cancel(
        key, version, site.cell.state().at, "nobody" if who is None else who.name
    )


@use_case(PEOPLE)
def list_questions(
    site: Site, who: Principal | None, *, open_only: bool = False, limit: int = 100
) -> tuple[QuestionView, ...]:
    """Questions of the cell to a person, the newest first."""
    del who
    return site.questions.list(open_only=open_only, limit=max(1, min(limit, MOST)))


@use_case(PEOPLE)
def get_question(site: Site, who: Principal | None, name: str) -> QuestionView:
    """A question and who answered it."""
    del who
    return site.questions.get(name)


@use_case(WORKERS, command=True)
def answer_question(site: Site, who: Principal | None, name: str, choice: str) -> QuestionView:
    """Answer a question of the cell; the first answer counts."""
    question = site.questions.get(name)
    if question.answered is not None:
        raise Conflict(f"{question.by} has answered this question already: {question.answer}")
    if choice not in question.choices:
        problem = Problem("choice", f"{choice[:40]!r}", ", ".join(question.choices))
        raise Unusable("no such answer", [problem])
    site.cell.answer(name, choice, "nobody" if who is None else who.name)
    return site.questions.get(name)
