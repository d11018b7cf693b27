"""Requests and questions."""

from datetime import datetime
from typing import Annotated

from fastapi import APIRouter, Header, Path, Query, Request
from starlette.responses import Response

from depal.server.api.bodies import ChangedRequest, Choice, NewRequest
from depal.server.api.encoding import said, serves, version_in, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers, leads
from depal.server.records import QuestionView, RequestView
from depal.server.site import Site
from depal.server.usecases import wanting as cases

KEY = Annotated[str, Path(min_length=1, max_length=100)]

LIMIT = Annotated[int, Query(ge=1, le=500)]


def wanting(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    del exposure
    _requests(router, site)
    _changes(router, site)
    _questions(router, site)


def _epoch(due: datetime | None) -> float | None:
    """Seconds since 1970."""
    return None if due is None else due.timestamp()


def _requests(router: APIRouter, site: Site) -> None:
    @router.post(
        "/requests",
        response_model=RequestView,
        status_code=201,
        responses=answers(404)
        | leads(201, "/key", get_request="key", change_request="key", cancel_request="key"),
        operation_id="add_request",
    )
    @serves(cases.add_request)
    def add_request(
        request: Request,
        body: NewRequest,
        idempotency_key: Annotated[str | None, Header(max_length=200)] = None,
    ) -> Response:
        """Ask for a product or a box; the same Idempotency-Key asks once."""
        view = cases.add_request(
            site,
            who_asks(request),
            gtin=body.gtin,
            box=body.box,
            priority=body.priority,
            due=_epoch(body.due),
            due_in=body.due_in,
            repeat=idempotency_key,
        )
        return said(view, 201, version=view.version)

    @router.get(
        "/requests",
        response_model=list[RequestView],
        responses=answers()
        | leads(200, "/0/key", get_request="key", change_request="key", cancel_request="key"),
        operation_id="list_requests",
    )
    @serves(cases.list_requests)
    def list_requests(
        request: Request,
        state: Annotated[str | None, Query(pattern="^(pending|served|rejected|cancelled)$")] = None,
        after: Annotated[int, Query(ge=0, le=2**62)] = 0,
        limit: LIMIT = 100,
    ) -> Response:
        """The requests in the order in which they came; `after` is the last one's number."""
        return said(cases.list_requests(site, who_asks(request), state, after, limit))

    @router.get(
        "/requests/{key}",
        response_model=RequestView,
        responses=answers(404),
        operation_id="get_request",
    )
    @serves(cases.get_request)
    def get_request(request: Request, key: KEY) -> Response:
        """A request and what became of it."""
        view = cases.get_request(site, who_asks(request), key)
        return said(view, version=view.version)


def _changes(router: APIRouter, site: Site) -> None:
    @router.patch(
        "/requests/{key}",
        response_model=RequestView,
        responses=answers(404, 412, 428),
        operation_id="change_request",
    )
    @serves(cases.change_request)
    def change_request(
        request: Request,
        key: KEY,
        body: ChangedRequest,
        if_match: Annotated[str | None, Header()] = None,
    ) -> Response:
        """Change the priority or the due time of a request."""
        del if_match
        view = cases.change_request(
            site,
            who_asks(request),
            key,
            version=version_in(request),
            priority=body.priority,
            due=_epoch(body.due),
            due_in=body.due_in,
            keep_due=body.keeps_due,
        )
        return said(view, version=view.version)

    @router.delete(
        "/requests/{key}",
        response_model=RequestView,
        responses=answers(404, 412, 428),
        operation_id="cancel_request",
    )
    @serves(cases.cancel_request)
    def cancel_request(
        request: Request, key: KEY, if_match: Annotated[str | None, Header()] = None
    ) -> Response:
        """A request is not wanted any more."""
        del if_match
        view = cases.cancel_request(site, who_asks(request), key, version_in(request))
        return said(view, version=view.version)


def _questions(router: APIRouter, site: Site) -> None:
    @router.get(
        "/questions",
        response_model=list[QuestionView],
        responses=answers(404) | leads(200, "/0/id", get_question="name", answer_question="name"),
        operation_id="list_questions",
    )
    @serves(cases.list_questions)
    def list_questions(
        request: Request,
        *,
        open_only: bool = False,
        limit: LIMIT = 100,
        before: Annotated[str | None, Query(max_length=200)] = None,
    ) -> Response:
        """Questions of the cell to a person, the newest first."""
        return said(
            cases.list_questions(
                site, who_asks(request), open_only=open_only, limit=limit, before=before
            )
        )

    @router.get(
        "/questions/{name:path}",
        response_model=QuestionView,
        responses=answers(404),
        operation_id="get_question",
    )
    @serves(cases.get_question)
    def get_question(request: Request, name: Annotated[str, Path(max_length=200)]) -> Response:
        """A question and who answered it."""
        return said(cases.get_question(site, who_asks(request), name))

    @router.put(
        "/answers/{name:path}",
        response_model=QuestionView,
        responses=answers(404),
        operation_id="answer_question",
    )
    @serves(cases.answer_question)
    def answer_question(
        request: Request, name: Annotated[str, Path(max_length=200)], body: Choice
    ) -> Response:
        """Answer a question of the cell; the first answer counts."""
        return said(cases.answer_question(site, who_asks(request), name, body.choice))
