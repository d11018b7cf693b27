"""Who may do what: every use case and every route, for every role and every bad credential."""

import importlib.util
import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest
from fastapi import APIRouter, FastAPI
from fastapi.routing import APIRoute
from fastapi.testclient import TestClient
from sites import PASSWORD, PEOPLE, REACHED, site_over

from depal.server.api import build_app
from depal.server.problems import Answer, Forbidden, SignInNeeded
from depal.server.roles import Principal, Role
from depal.server.site import Site
from depal.server.usecases import deliveries, managing, use_cases, wanting, working
from depal.server.usecases.registry import MARK

ROOT = Path(__file__).parent.parent.parent

MODULES = (working, wanting, deliveries, managing)

TABLE = {
    None: {"make_first_account", "see_health", "sign_in"},
    "all": {
        "assign_product": "i", "add_token": "i", "add_person": "i", "change_person": "i",
        "change_settings": "i", "list_people": "i", "list_tokens": "i", "put_picture": "i",
        "put_product": "i", "read_audit": "i", "remove_person": "i", "revoke_token": "i",
        "verify_audit": "i",
        "add_deliveries": "oi", "answer_question": "oi", "cancel_delivery": "oi",
        "check_deliveries": "oi", "hold": "oi", "move_delivery": "oi", "resume": "oi",
        "start": "oi", "stop_after_box": "oi",
        "add_request": "ois", "cancel_request": "ois", "change_request": "ois",
        "ask_why": "voi", "get_delivery": "voi", "get_picture": "voi", "get_question": "voi",
        "get_run": "voi", "list_deliveries": "voi", "list_questions": "voi", "list_runs": "voi",
        "open_record": "voi", "see_picture": "voi", "see_settings": "voi", "see_state": "voi",
        "see_trees": "voi", "set_password": "voi", "sign_out": "voi",
        "get_product": "vois", "get_request": "vois", "last_event": "vois",
        "list_places": "vois", "list_products": "vois", "list_requests": "vois",
        "read_events": "vois", "see_me": "vois", "see_stock": "vois",
    },
}  # fmt: skip
"""By hand, from what each role is for; the code has its own word on it."""

LETTERS = {Role.VIEWER: "v", Role.OPERATOR: "o", Role.INTEGRATOR: "i", Role.SERVICE: "s"}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Site:
    """One for all of these tests: they change nothing that matters to them."""
    return site_over(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="module")
def client(site: Site) -> Iterator[TestClient]:
    """Over its API."""
    with TestClient(build_app(site, REACHED), raise_server_exceptions=False) as client:
        yield client


def test_every_use_case_has_the_roles_of_the_table() -> None:
    """One that is new fails here until somebody has thought about it."""
    cases = use_cases()
    found = {
        name: None if case.roles is None else "".join(
            letter for role, letter in LETTERS.items() if role in case.roles
        )
        for name, case in cases.items()
    }  # fmt: skip
    assert found == {**dict.fromkeys(TABLE[None]), **TABLE["all"]}


def test_every_public_function_of_a_use_case_module_is_a_use_case() -> None:
    """Nothing gets around the roles by being forgotten."""
    cases = use_cases()
    for module in MODULES:
        for name, member in vars(module).items():
            if inspect.isfunction(member) and member.__module__ == module.__name__:
                assert name.startswith("_") or name in cases, name


@pytest.mark.parametrize("name", sorted(use_cases()))
@pytest.mark.parametrize("role", list(Role))
def test_a_use_case_refuses_before_it_looks_at_anything(site: Site, name: str, role: Role) -> None:
    """Nobody and the wrong role are refused whatever else is wrong; audited where it commands."""
    case = use_cases()[name]
    function = next(vars(module)[name] for module in MODULES if name in vars(module))
    if case.roles is None:
        return
    with pytest.raises(SignInNeeded):
        function(site, None)
    if role in case.roles:
        return
    before = site.audit.list(limit=10_000)
    with pytest.raises(Forbidden):
        function(site, Principal("somebody", role))
    lines = site.audit.list(limit=10_000)[len(before) :]
    assert [(line.what, line.who) for line in lines] == [(name, "somebody")] * case.command


def operations(client: TestClient) -> list[tuple[str, str]]:
    """Method and path of every operation that the OpenAPI document tells of."""
    paths = client.get("/openapi.json").json()["paths"]
    return [(method.upper(), path) for path, methods in paths.items() for method in methods]


OPEN = {
    ("GET", "/api/v1/health"),
    ("POST", "/api/v1/first-account"),
    ("POST", "/api/v1/sign-in"),
}


def filled(path: str) -> str:
    """A path with something for each of its parameters."""
    out = path
    while "{" in out:
        start, end = out.index("{"), out.index("}")
        name = out[start + 1 : end]
        value = {"number": "1", "face": "front"}.get(name, "something")
        out = out[:start] + value + out[end + 1 :]
    return f"{out}?wait=0" if out.endswith("/events") else out


def test_every_route_serves_a_use_case_and_three_are_for_everybody(client: TestClient) -> None:
    """By the mark that the gate reads; `open_record` serves the screen alone."""
    marks = {
        (method, route.path): getattr(route.endpoint, MARK, None)
        for route in _routes(client)
        for method in route.methods or ()
    }
    assert [key for key, case in marks.items() if case is None] == []
    everybody = {key for key, case in marks.items() if case is not None and case.roles is None}
    assert everybody == OPEN
    served = {case.name for case in marks.values() if case is not None}
    assert set(use_cases()) - served == {"open_record", "last_event"}


def test_a_route_without_a_use_case_is_for_nobody(site: Site) -> None:
    """Whoever forgets to say who may use it has opened nothing."""
    app = build_app(site, REACHED)
    router = next(r for r in _routers(app) if r.routes)

    @router.get("/forgotten")
    def forgotten() -> str:
        return "everything"

    with TestClient(app) as client:
        assert client.get("/api/v1/forgotten").status_code == 401
        cookie = {"cookie": f"depal={site.sessions.open('ines')}"}
        assert client.get("/api/v1/forgotten", headers=cookie).status_code == 403


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"authorization": "Bearer depal_wrong"},
        {"authorization": "Basic dmVyYTp2ZXJh"},
        {"authorization": ""},
        {"cookie": "depal=wrong"},
        {"cookie": "depal="},
    ],
)
def test_without_good_credentials_all_but_three_operations_are_refused(
    client: TestClient, headers: dict[str, str]
) -> None:
    """Before the body is looked at: it is no JSON, and too much is wrong with it."""
    for method, path in operations(client):
        if (method, path) in OPEN:
            continue
        response = client.request(
            method,
            filled(path),
            headers={**headers, "content-type": "application/json"},
            content=b"{this is no JSON" if method != "GET" else None,
        )
        # A cookie without an origin may come from another site: that is said first.
        expected = {401, 403} if headers.get("cookie") == "depal=wrong" else {401}
        assert response.status_code in expected, (method, path, response.text)
        assert response.headers["content-type"] == "application/problem+json"


def test_an_expired_token_and_an_expired_session_are_refused(
    site: Site, client: TestClient
) -> None:
    """The clock decides, and it may jump."""
    chance = site.chance
    _, secret = site.tokens.add("till", 1.0)
    session = site.sessions.open("vera")
    good = [{"authorization": f"Bearer {secret}"}, {"cookie": f"depal={session}"}]
    assert [client.get("/api/v1/me", headers=each).status_code for each in good] == [200, 200]
    chance.time += 86400.0  # type: ignore[attr-defined]
    assert [client.get("/api/v1/me", headers=each).status_code for each in good] == [401, 401]
    chance.time -= 10 * 86400.0  # type: ignore[attr-defined]
    assert client.get("/api/v1/me", headers=good[0]).status_code == 401
    chance.time += 9 * 86400.0  # type: ignore[attr-defined]


def test_every_route_and_role_as_the_table_says(site: Site, client: TestClient) -> None:
    """403 where the table says no; where it says yes, anything else."""
    _, secret = site.tokens.add("every route", 1.0)
    credentials = {role: {"cookie": f"depal={site.sessions.open(PEOPLE[role])}"} for role in PEOPLE}
    credentials[Role.SERVICE] = {"authorization": f"Bearer {secret}"}
    routes = {
        (method, route.path.replace(":path}", "}")): route.operation_id
        for route in _routes(client)
        for method in route.methods or ()
    }
    alias = {"stop": "stop_after_box", "stream_events": "read_events"}
    for method, path in operations(client):
        if (method, path) in OPEN:
            continue
        name = routes[method, path]
        allowed = TABLE["all"][alias.get(name, name)]
        for role, headers in credentials.items():
            origin = {"origin": "http://testserver", "content-type": "application/json"}
            response = client.request(
                method,
                filled(path),
                headers={**headers, **origin},
                content=b"[]"
                if method in {"POST", "PUT", "PATCH"} and name != "sign_out"
                else None,
            )
            expected = LETTERS[role] in allowed
            assert (response.status_code != 403) is expected or (
                name == "set_password" and response.status_code == 403
            ), (method, path, role, response.text)
            assert response.status_code < 500, (method, path, response.text)
            if name == "sign_out":
                credentials[role] = (
                    {"cookie": f"depal={site.sessions.open(PEOPLE[role])}"}
                    if role in PEOPLE
                    else headers
                )


def _routers(app: FastAPI) -> list[APIRouter]:
    inner = [getattr(route, "original_router", None) for route in app.router.routes]
    return [each for each in inner if isinstance(each, APIRouter)]


def _routes(client: TestClient) -> list[APIRoute]:
    routers = _routers(cast("FastAPI", client.app))
    return [each for router in routers for each in router.routes if isinstance(each, APIRoute)]


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
        {"origin": "null"},
        {},
    ],
)
def test_another_site_cannot_command_through_a_browser(
    site: Site, client: TestClient, headers: dict[str, str]
) -> None:
    """A cookie alone is not enough for what changes something."""
    cookie = {"cookie": f"depal={site.sessions.open('otto')}"}
    response = client.post("/api/v1/commands/hold", headers={**cookie, **headers})
    assert response.status_code == 403
    assert "another site" in response.json()["detail"]


def test_a_name_that_is_not_ours_is_not_answered(client: TestClient) -> None:
    """DNS rebinding: the Host header says what the browser was told."""
    response = client.get("/api/v1/health", headers={"host": "evil.example"})
    assert response.status_code == 421


def test_guessing_a_password_gets_slower_and_the_right_one_waits_too(tmp_path: Path) -> None:
    """By account and by address; after the wait it works again."""
    site = site_over(tmp_path, busy=False)
    with TestClient(build_app(site, REACHED)) as client:

        def sign_in(password: str) -> tuple[int, str]:
            body = {"name": "vera", "password": password}
            response = client.post("/api/v1/sign-in", json=body)
            return response.status_code, response.headers.get("retry-after", "")

        assert {sign_in("wrong password") for _ in range(5)} == {(401, "")}
        status, wait = sign_in(PASSWORD)
        assert status == 429
        site.chance.time += float(wait) + 1.0  # type: ignore[attr-defined]
        assert sign_in(PASSWORD)[0] == 200


def test_an_answer_says_its_status() -> None:
    """Every kind of answer has a status of its own."""
    kinds = Answer.__subclasses__()
    assert len({kind.status for kind in kinds}) == len(kinds)


def test_the_page_about_the_api_tells_the_table_as_it_is() -> None:
    """`python scripts/api_table.py` brings it up to date."""
    spec = importlib.util.spec_from_file_location("api_table", ROOT / "scripts" / "api_table.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    text = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    assert module.page(text) == text
