"""Requests and questions: what the store wants, and what the cell wants to know."""

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
    due_in: float | None = None,
    repeat: str | None = None,
) -> RequestView:
    """Ask for a product or a box; the same Idempotency-Key asks once."""
    name = "nobody" if who is None else who.name
    body = {"gtin": gtin, "box": box, "priority": priority, "due": due, "due_in": due_in}
    before = None if repeat is None else _asked_before(site, name, repeat, body)
    if before is not None:
        return before
    when = due if due_in is None else site.chance.now() + due_in
    wanted = _wanted(site, gtin, box, priority, when)
    run = None if box is None else site.cell.state().run
    key = f"r-{site.chance.secret(9)}"
    if repeat is not None:
        key = site.repeats.claim(name, repeat, body, key)
    view = site.requests.add(key, wanted, by=name, run=run, due=when)
    try:
        site.cell.add_request(key, wanted)
    except DepalError as error:
        site.requests.end(key, served=False, at=wanted.arrived, reason=str(error))
        if repeat is not None:
            site.repeats.forget(name, repeat)
        raise
    return view


def _asked_before(site: Site, name: str, repeat: str, body: object) -> RequestView | None:
    """What the same request has come to, though it could not be made any more."""
    key = site.repeats.seen(name, repeat, body)
    try:
        return None if key is None else site.requests.get(key)
    except NotFound:  # the server ended before it was written down
        return None


def _wanted(
    site: Site, gtin: str | None, box: str | None, priority: float, due: float | None
) -> Request:
    """A request that can be served, on the cell's clock."""
    state = site.cell.state()
    if box is not None:
        _look_for_box(site, box)
    elif gtin is not None:
        _of_a_product(site, gtin)
    return Request(
        priority,
        gtin=None if gtin is None else Gtin(gtin),
        box=None if box is None else BoxId(box),
        arrived=state.at,
        due=_checked_due(site, due, state.at),
    )


def _of_a_product(site: Site, gtin: str) -> None:
    if site.store.product(Gtin(gtin)) is None:
        known = [product.gtin for product in site.store.products("", "", MOST)]
        raise NotFound(f"the store knows no product {gtin[:40]!r}; {did_you_mean(gtin, known)}")


def _look_for_box(site: Site, box: str) -> None:
    state = site.cell.state()
    if state.run is None:
        raise Conflict("no pallet is worked on, so no box can be asked for")
    standing = {each.box: each.place for each in state.standing}
    if box in standing:
        raise Conflict(f"box {box!r} is stored already: it stands in {standing[box]}")
    known = [line.box for line in state.queue]
    if box not in known:
        raise NotFound(f"no box {box[:40]!r} stands on the pallet; {did_you_mean(box, known)}")


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
    version: int | None = None,
    priority: float | None = None,
    due: float | None = None,
    due_in: float | None = None,
    keep_due: bool = False,
) -> RequestView:
    """Change the priority or the due time of a request."""
    del who
    kept = site.requests.get(key)
    p = kept.priority if priority is None else priority
    if not 0.0 <= p <= 1.0:
        problem = Problem("priority", f"{p!r} is out of range", "a number in [0, 1]")
        raise Unusable("this request cannot be used", [problem])
    now = site.cell.state().at
    when = due if due_in is None else site.chance.now() + due_in
    if keep_due or when == kept.due:
        when, clock = kept.due, _overdue_too(site, kept.due, now)
    else:
        clock = _checked_due(site, when, now)
    changed = kept.version if version is None else version
    request = site.requests.change(key, changed, p, (clock, when))
    site.cell.change_request(key, request)
    return site.requests.get(key)


def _overdue_too(site: Site, due: float | None, at: float) -> float | None:
    """A due time on the cell's clock; one that has passed is now."""
    return None if due is None else at + max(due - site.chance.now(), 0.0)


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
    site: Site,
    who: Principal | None,
    *,
    open_only: bool = False,
    limit: int = 100,
    before: str | None = None,
) -> tuple[QuestionView, ...]:
    """Questions of the cell to a person, the newest first."""
    del who
    page = max(1, min(limit, MOST))
    return site.questions.list(open_only=open_only, limit=page, before=before)


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
    by = "nobody" if who is None else who.name
    site.cell.answer(name, choice, by)
    site.questions.answered(name, choice, by, site.cell.state().at)  # where the cell has not yet
    return site.questions.get(name)
