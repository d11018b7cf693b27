"""Signing in, people, tokens, audit, runs, health."""

from typing import Annotated

from fastapi import APIRouter, Header, Path, Query, Request
from starlette.responses import Response

from depal.server.api.bodies import (
    FirstAccount,
    NewPassword,
    NewPerson,
    NewRole,
    NewToken,
    SignIn,
)
from depal.server.api.encoding import said, serves, version_in, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers, leads
from depal.server.people import AuditLine, PersonView, TokenView
from depal.server.people.sessions import LONGEST
from depal.server.records import RunView
from depal.server.roles import Principal
from depal.server.site import Site
from depal.server.usecases import managing as cases

NAME = Annotated[str, Path(min_length=1, max_length=100)]

LIMIT = Annotated[int, Query(ge=1, le=500)]

PERSON = {"change_person": "name", "set_password": "name", "remove_person": "name"}

TOKEN = {"revoke_token": "token"}

MATCH = Annotated[str | None, Header(description="the ETag of what is changed, or *")]

AFTER = Annotated[int, Query(ge=0, le=2**62)]


def managing(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    _signing(router, site, exposure)
    _people(router, site)
    _tokens(router, site)
    _audit(router, site)
    _runs(router, site)


def cookied(signed: cases.SignedIn, exposure: Exposure) -> Response:
    """Who has signed in, with the cookie for their browser."""
    response = said(signed.who)
    response.set_cookie(
        exposure.cookie,
        signed.secret,
        max_age=int(LONGEST),
        httponly=True,
        secure=exposure.secure,
        samesite="strict",
        path="/",
    )
    return response


def _address(request: Request) -> str:
    return "" if request.client is None else request.client.host


def _signing(router: APIRouter, site: Site, exposure: Exposure) -> None:
    @router.get("/health", response_model=cases.Health, operation_id="health")
    @serves(cases.see_health)
    def health(request: Request) -> Response:
        """Whether the server answers, and which version it is."""
        return said(cases.see_health(site, who_asks(request)))

    @router.post(
        "/first-account",
        response_model=Principal,
        responses=answers(429),
        operation_id="make_first_account",
    )
    @serves(cases.make_first_account)
    def make_first_account(request: Request, body: FirstAccount) -> Response:
        """Make the first account with the one-time code of the first start."""
        who, address = who_asks(request), _address(request)
        signed = cases.make_first_account(site, who, body.code, body.name, body.password, address)
        return cookied(signed, exposure)

    @router.post(
        "/sign-in", response_model=Principal, responses=answers(429), operation_id="sign_in"
    )
    @serves(cases.sign_in)
    def sign_in(request: Request, body: SignIn) -> Response:
        """Sign in with a name and a password; the cookie does the rest."""
        signed = cases.sign_in(site, who_asks(request), body.name, body.password, _address(request))
        return cookied(signed, exposure)

    @router.post("/sign-out", status_code=204, responses=answers(), operation_id="sign_out")
    @serves(cases.sign_out)
    def sign_out(request: Request) -> Response:
        """Sign out."""
        cases.sign_out(site, who_asks(request), request.cookies.get(exposure.cookie, ""))
        response = said(None, 204)
        response.delete_cookie(exposure.cookie, path="/", secure=exposure.secure, httponly=True)
        return response

    @router.get("/me", response_model=Principal, responses=answers(), operation_id="see_me")
    @serves(cases.see_me)
    def see_me(request: Request) -> Response:
        """Who is asking."""
        return said(cases.see_me(site, who_asks(request)))


def _people(router: APIRouter, site: Site) -> None:
    @router.get(
        "/people", response_model=list[PersonView], responses=answers(), operation_id="list_people"
    )
    @serves(cases.list_people)
    def list_people(request: Request) -> Response:
        """The accounts."""
        return said(cases.list_people(site, who_asks(request)))

    @router.post(
        "/people",
        response_model=PersonView,
        status_code=201,
        responses=answers() | leads(201, "/name", **PERSON),
        operation_id="add_person",
    )
    @serves(cases.add_person)
    def add_person(request: Request, body: NewPerson) -> Response:
        """Add a person."""
        who = who_asks(request)
        person = cases.add_person(site, who, body.name, body.role, body.password)
        return said(person, 201, version=person.version)

    @router.put(
        "/people/{name}/role",
        response_model=PersonView,
        responses=answers(404, 412, 428),
        operation_id="change_person",
    )
    @serves(cases.change_person)
    def change_person(
        request: Request, name: NAME, body: NewRole, if_match: MATCH = None
    ) -> Response:
        """Give a person another role."""
        del if_match
        version = version_in(request)
        person = cases.change_person(site, who_asks(request), name, body.role, version)
        return said(person, version=person.version)

    @router.put(
        "/people/{name}/password",
        status_code=204,
        responses=answers(404),
        operation_id="set_password",
    )
    @serves(cases.set_password)
    def set_password(request: Request, name: NAME, body: NewPassword) -> Response:
        """Set a password: one's own, or as an integrator anybody's."""
        cases.set_password(site, who_asks(request), name, body.password)
        return said(None, 204)

    @router.delete(
        "/people/{name}",
        status_code=204,
        responses=answers(404, 412, 428),
        operation_id="remove_person",
    )
    @serves(cases.remove_person)
    def remove_person(request: Request, name: NAME, if_match: MATCH = None) -> Response:
        """Remove a person."""
        del if_match
        cases.remove_person(site, who_asks(request), name, version_in(request))
        return said(None, 204)


def _tokens(router: APIRouter, site: Site) -> None:
    @router.get(
        "/tokens", response_model=list[TokenView], responses=answers(), operation_id="list_tokens"
    )
    @serves(cases.list_tokens)
    def list_tokens(request: Request) -> Response:
        """The tokens of services, without their secrets."""
        return said(cases.list_tokens(site, who_asks(request)))

    @router.post(
        "/tokens",
        response_model=cases.NewToken,
        status_code=201,
        responses=answers() | leads(201, "/token/id", **TOKEN),
        operation_id="add_token",
    )
    @serves(cases.add_token)
    def add_token(request: Request, body: NewToken) -> Response:
        """Make a token for a service; its secret is shown this once."""
        return said(cases.add_token(site, who_asks(request), body.name, body.days), 201)

    @router.delete(
        "/tokens/{token}",
        response_model=TokenView,
        responses=answers(404),
        operation_id="revoke_token",
    )
    @serves(cases.revoke_token)
    def revoke_token(request: Request, token: NAME) -> Response:
        """A token is good no longer."""
        return said(cases.revoke_token(site, who_asks(request), token))


def _audit(router: APIRouter, site: Site) -> None:
    @router.get(
        "/audit", response_model=list[AuditLine], responses=answers(), operation_id="read_audit"
    )
    @serves(cases.read_audit)
    def read_audit(request: Request, after: AFTER = 0, limit: LIMIT = 100) -> Response:
        """The audit log after a line."""
        return said(cases.read_audit(site, who_asks(request), after, limit))

    @router.get(
        "/audit/verify",
        response_model=cases.Verified,
        responses=answers(),
        operation_id="verify_audit",
    )
    @serves(cases.verify_audit)
    def verify_audit(request: Request) -> Response:
        """Whether the audit log is whole."""
        return said(cases.verify_audit(site, who_asks(request)))


def _runs(router: APIRouter, site: Site) -> None:
    @router.get(
        "/runs",
        response_model=list[RunView],
        responses=answers() | leads(200, "/0/number", get_run="number"),
        operation_id="list_runs",
    )
    @serves(cases.list_runs)
    def list_runs(
        request: Request,
        before: Annotated[int | None, Query(ge=1, le=2**62)] = None,
        limit: LIMIT = 50,
    ) -> Response:
        """The runs, the newest first."""
        return said(cases.list_runs(site, who_asks(request), before, limit))

    @router.get(
        "/runs/{number}", response_model=RunView, responses=answers(404), operation_id="get_run"
    )
    @serves(cases.get_run)
    def get_run(request: Request, number: Annotated[int, Path(ge=1, le=2**62)]) -> Response:
        """A run and what came of it."""
        return said(cases.get_run(site, who_asks(request), number))
