"""How each operation is made to succeed: a few calls over HTTP that a client would make."""

from collections.abc import Callable
from typing import Any

from fastapi import FastAPI
from fastapi.testclient import TestClient
from sites import LINE, PASSWORD, PEOPLE, upload

from depal.server.roles import Role
from depal.server.site import Site

SUCCESSES = 20
"""Every operation succeeds at least so often."""

Note = Callable[[str, int, float], None]

GTIN = LINE.product.gtin

JPEG = b"\xff\xd8\xff\xd9"

PRODUCT = {"name": "biscuits", "size": [0.3, 0.2, 0.25], "mass": 4.0}


class Caller:
    """Calls, and notes what came of each."""

    def __init__(self, client: TestClient, site: Site, note: Note) -> None:
        """As an integrator."""
        self._client, self._site, self._note = client, site, note
        self._secret = site.sessions.open(PEOPLE[Role.INTEGRATOR])

    def __call__(self, method: str, path: str, values: tuple[str, ...] = (), **how: Any) -> Any:  # noqa: ANN401 - JSON
        """One call of an operation, with values for the parameters of its path."""
        url = path
        for value in values:
            start, end = url.index("{"), url.index("}")
            url = url[:start] + value + url[end + 1 :]
        headers = {"cookie": f"depal={self._secret}", "origin": "http://testserver"}
        headers |= how.pop("headers", {})
        response = self._client.request(method, f"/api/v1{url}", headers=headers, **how)
        self._note(f"{method} /api/v1{path}", response.status_code, 0.0)
        assert response.status_code < 300, (method, url, response.text)
        kind = response.headers.get("content-type", "")
        return response.json() if kind == "application/json" else response


def succeed(app: FastAPI, site: Site, note: Note) -> None:
    """Every operation, as often as is wanted."""
    with TestClient(app) as client:
        call = Caller(client, site, note)
        site.runs.end(1, "done", {})  # one run at a time
        for number in range(SUCCESSES):
            _look(call)
            _want(call, number)
            _stock(call, number)
            _manage(call, site, number)
            _work(call, site, number)


ANY = {"headers": {"if-match": "*"}}


def _look(call: Caller) -> None:
    for path in ("/state", "/trees", "/picture", "/settings", "/journal", "/deliveries", "/places"):
        call("GET", path)
    for path in ("/stock", "/products", "/requests", "/questions", "/people", "/tokens", "/audit"):
        call("GET", path)
    for path in ("/audit/verify", "/runs", "/me", "/health"):
        call("GET", path)
    call("GET", "/runs/{number}", ("1",))
    call("GET", "/events", params={"wait": 0})
    call("PUT", "/settings", json={"w": 0.4, "speed": 0.9, "policy": "paper"}, **ANY)


def _want(call: Caller, number: int) -> None:
    made = call("POST", "/requests", json={"gtin": GTIN, "priority": 0.3, "due_in": 60.0})
    call("GET", "/requests/{key}", (made["key"],))
    again = {"if-match": f'"{made["version"]}"'}
    call("PATCH", "/requests/{key}", (made["key"],), json={"priority": 0.7}, headers=again)
    call("DELETE", "/requests/{key}", (made["key"],), **ANY)
    del number


def _stock(call: Caller, number: int) -> None:
    name = f"made-{number}"
    kind = {"headers": {"content-type": "application/json"}}
    call("POST", "/deliveries/check", content=upload(name), **kind)
    call("POST", "/deliveries", content=upload(name), **kind)
    call("GET", "/deliveries/{name}", (name,))
    call("PUT", "/deliveries/{name}/position", (name,), json={"position": 1}, **ANY)
    call("DELETE", "/deliveries/{name}", (name,), **ANY)
    call("GET", "/products/{gtin}", (GTIN,))
    call("PUT", "/products/{gtin}", (GTIN,), json=PRODUCT, **ANY)
    places = {"places": ["trolley_1/level_1"]}
    call("PUT", "/products/{gtin}/places", (GTIN,), json=places, **ANY)
    jpeg = {"headers": {"content-type": "image/jpeg"}}
    call("PUT", "/products/{gtin}/pictures/{face}", (GTIN, "front"), content=JPEG, **jpeg)
    call("GET", "/products/{gtin}/pictures/{face}", (GTIN, "front"))


def _manage(call: Caller, site: Site, number: int) -> None:
    name = f"person {number}"
    person = {"name": name, "password": PASSWORD, "role": "viewer"}
    call("POST", "/people", json=person)
    call("PUT", "/people/{name}/role", (name,), json={"role": "operator"}, **ANY)
    call("PUT", "/people/{name}/password", (name,), json={"password": PASSWORD})
    site.chance.time += 1000.0  # type: ignore[attr-defined] # what failed before is forgiven
    call("POST", "/sign-in", json={"name": name, "password": PASSWORD})
    secret = site.sessions.open(name)
    call("POST", "/sign-out", headers={"cookie": f"depal={secret}"})
    call("DELETE", "/people/{name}", (name,), **ANY)
    token = call("POST", "/tokens", json={"name": "a service", "days": 1.0})
    call("DELETE", "/tokens/{token}", (token["token"]["id"],))
    _first(call, site)


def _first(call: Caller, site: Site) -> None:
    """The first account needs a cell without people: they are put back afterwards."""
    from depal.logistics.store.served_tables import AccountRow, SessionRow  # noqa: PLC0415

    with site.store.database.session() as session:
        kept = [_plain(row) for kind in (AccountRow, SessionRow) for row in session.query(kind)]
        session.query(SessionRow).delete()
        session.query(AccountRow).delete()
    site.chance.time += 1000.0  # type: ignore[attr-defined] # what failed before is forgiven
    first = {"name": "first", "password": PASSWORD, "code": site.codes.make()}
    call("POST", "/first-account", json=first)
    with site.store.database.session() as session:
        session.query(SessionRow).delete()
        session.query(AccountRow).delete()
        for kind, values in kept:
            session.add(kind(**values))
            session.flush()


def _plain(row: Any) -> tuple[type, dict[str, object]]:  # noqa: ANN401 - of any table
    return type(row), {column.name: getattr(row, column.name) for column in row.__table__.columns}


def _work(call: Caller, site: Site, number: int) -> None:
    from dataclasses import replace  # noqa: PLC0415

    from sites import SOLID  # noqa: PLC0415

    from depal.server.cellstate import (  # noqa: PLC0415
        CellState,
        Mode,
        QuestionState,
        QueueLine,
    )

    cell = site.cell
    cell.tell(CellState())  # type: ignore[attr-defined]
    name = f"work-{number}"
    call("POST", "/deliveries", content=upload(name), headers={"content-type": "application/json"})
    run = call("POST", "/commands/start", json={"delivery": name})["run"]
    call("POST", "/commands/hold")
    call("POST", "/commands/resume")
    call("POST", "/commands/stop")
    call("POST", "/commands/start")
    line = QueueLine("b1", None, "", SOLID, 0.1, 0.0, 0.1, "chosen", "it is free")
    cell.tell(replace(cell.state(), queue=(line,)))  # type: ignore[attr-defined]
    call("GET", "/boxes/{box}/why", ("b1",))
    question = QuestionState(f"{run}/take/b1/0-1", "Take it?", ("taken", "no"), "b1", 0.0)
    site.questions.asked(run, question)
    call("GET", "/questions/{name}", (question.id,))
    call("PUT", "/answers/{name}", (question.id,), json={"choice": "taken"})
    cell.tell(replace(cell.state(), mode=Mode.COMPLETE))  # type: ignore[attr-defined]
    site.runs.end(run, "done", {})
