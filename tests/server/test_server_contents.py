"""Kinds of content, faults, and names that are hard to ask for."""

from collections.abc import Iterator
from urllib.parse import quote

import pytest
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from sites import LINE, PASSWORD, REACHED, site_over, upload

from depal.errors import DeviceError
from depal.server.api import Exposure, build_app
from depal.server.api.contents import accepts
from depal.server.site import Site

GTIN = LINE.product.gtin

PROBLEM = "application/problem+json"

NOTE = "gtin,name,length_m,width_m,height_m,mass_kg,count\n12000823098180,rice,0.3,0.2,0.2,5,1\n"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Site:
    """Busy, with people; one for all of these tests."""
    return site_over(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="module")
def client(site: Site) -> Iterator[TestClient]:
    """Signed in as an integrator."""
    with TestClient(build_app(site, REACHED), raise_server_exceptions=False) as client:
        body = {"name": "ines", "password": PASSWORD}
        assert client.post("/api/v1/sign-in", json=body).status_code == 200
        client.headers["origin"] = "http://testserver"
        yield client


@pytest.mark.parametrize(
    ("method", "path", "kind", "status"),
    [
        ("POST", "/requests", "image/png", 415),
        ("POST", "/requests", "text/plain", 415),
        ("POST", "/requests", "application/x-www-form-urlencoded", 415),
        ("POST", "/requests", "", 415),
        ("POST", "/requests", "Application/JSON; charset=utf-8", 422),
        ("POST", "/deliveries", "image/png", 415),
        ("POST", "/deliveries", "text/csv", 422),
        ("PUT", f"/products/{GTIN}/pictures/front", "application/json", 415),
        ("PUT", f"/products/{GTIN}/pictures/front", "image/png", 415),
        ("DELETE", "/requests/r-1", "text/plain", 415),
    ],
)
def test_each_operation_takes_its_own_kinds(
    client: TestClient, method: str, path: str, kind: str, status: int
) -> None:
    """What is no PNG is none, whatever it is called."""
    headers = {"content-type": kind}
    response = client.request(method, f"/api/v1{path}", content=b"{}", headers=headers)
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == PROBLEM


@pytest.mark.parametrize(
    ("path", "accept", "status"),
    [
        ("/state", "text/html", 406),
        ("/state", "application/json;q=0, */*;q=0.1", 200),
        ("/state", "application/*", 200),
        ("/state", "*/*;q=0", 406),
        ("/picture", "application/json", 406),
        ("/picture", "image/avif, image/*;q=0.5", 200),
        ("/events?wait=0", "text/event-stream", 200),
        ("/nothing", "text/html", 404),
    ],
)
def test_a_client_says_what_it_takes(
    client: TestClient, path: str, accept: str, status: int
) -> None:
    """Only where there is something; problems are told in any case."""
    response = client.get(f"/api/v1{path}", headers={"accept": accept})
    assert response.status_code == status
    if status != 200:
        assert response.headers["content-type"] == PROBLEM


@given(st.text(max_size=60), st.sampled_from([("application/json",), ("image/png", "image/jpeg")]))
def test_an_accept_header_means_something_or_nothing_but_never_fails(
    header: str, kinds: tuple[str, ...]
) -> None:
    """And with anything allowed beside it, it allows everything."""
    assert accepts(header, kinds) in {True, False}
    assert accepts(f"{header},*/*", kinds)


@pytest.mark.parametrize("origin", ["http://[evil", "http://", "://", "testserver", "null"])
def test_an_origin_that_is_none_of_ours_is_refused(client: TestClient, origin: str) -> None:
    """Also one that is no URL."""
    response = client.post("/api/v1/commands/hold", headers={"origin": origin})
    assert response.status_code == 403


def test_hosts_are_names_and_names_have_no_case() -> None:
    """With a port or without; IPv6 in brackets."""
    exposure = Exposure(frozenset({"cell.example"}))
    for host in ("LocalHost:8080", "[::1]:8080", "[::1]", "Cell.Example", "127.0.0.1"):
        assert exposure.allows(host)
    for host in ("", "evil.example", "localhost.evil.example", "cell.example@evil.example"):
        assert not exposure.allows(host)


def test_a_body_without_a_length_is_counted(client: TestClient) -> None:
    """It is refused at its limit, whatever operation it is for."""
    pieces = (b" " * 65536 for _ in range(30))
    response = client.post(
        "/api/v1/requests", content=pieces, headers={"content-type": "application/json"}
    )
    assert response.status_code == 413
    assert response.headers["content-type"] == PROBLEM


def test_a_fault_of_the_server_is_a_problem_that_tells_nothing_of_its_inside(
    site: Site, client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And a command that met it is in the audit log."""

    def fail(source: str) -> None:
        raise ZeroDivisionError(f"in {source}")

    monkeypatch.setattr(site.cell, "hold", fail)
    response = client.post("/api/v1/commands/hold")
    assert response.status_code == 500
    assert response.headers["content-type"] == PROBLEM
    assert "ZeroDivision" not in response.text
    assert site.audit.list(limit=500)[-1].outcome == "a fault: ZeroDivisionError"


def test_a_database_that_does_not_answer_is_said_so(
    site: Site, client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Already at the door, where it is asked who is there."""

    def fail(secret: str) -> None:
        raise DeviceError(f"the disk is gone, and {len(secret)} characters with it")

    monkeypatch.setattr(type(site.sessions), "who", lambda _, secret: fail(secret))
    response = client.get("/api/v1/state")
    assert response.status_code == 503
    assert response.headers["content-type"] == PROBLEM


def test_every_answer_has_the_headers_that_browsers_are_to_heed(site: Site) -> None:
    """Refusals too; over TLS browsers are told to stay there."""
    exposure = Exposure(frozenset({"cell.example"}), secure=True)
    with TestClient(build_app(site, exposure)) as client:
        for host, status in (("cell.example", 401), ("evil.example", 421)):
            response = client.get("/api/v1/state", headers={"host": host})
            assert response.status_code == status
            assert response.headers["x-content-type-options"] == "nosniff"
            assert "default-src 'none'" in response.headers["content-security-policy"]
            assert response.headers["strict-transport-security"] == "max-age=31536000"
        body = {"name": "vera", "password": PASSWORD}
        signed = client.post("/api/v1/sign-in", json=body, headers={"host": "cell.example"})
        cookie = signed.headers["set-cookie"].lower()
        assert cookie.startswith("__host-depal=")
        for part in ("secure", "httponly", "samesite=strict", "path=/"):
            assert part in cookie
        assert "domain" not in cookie


@pytest.mark.parametrize("name", ["2026/0815", "a b", "100 %", "?x#y", "caffè", "a/../b", "check"])
def test_a_delivery_can_be_asked_for_whatever_it_is_called(client: TestClient, name: str) -> None:
    """Its name is part of an address."""
    kind = {"content-type": "application/json"}
    made = client.post("/api/v1/deliveries", content=upload(name), headers=kind)
    assert made.status_code == 201
    path = f"/api/v1/deliveries/{quote(name, safe='')}"
    assert client.get(path).json()["id"] == name
    match = {"if-match": "*"}
    moved = client.put(f"{path}/position", json={"position": 1}, headers=match)
    assert moved.json()["position"] == 1
    assert client.delete(path, headers=match).json()["state"] == "cancelled"


@pytest.mark.parametrize("name", [".", "..", "x" * 101])
def test_a_delivery_that_nobody_could_ask_for_is_not_taken(client: TestClient, name: str) -> None:
    """Dots alone mean another address."""
    kind = {"content-type": "application/json"}
    response = client.post("/api/v1/deliveries", content=upload(name), headers=kind)
    assert response.status_code == 422
    assert [problem["where"] for problem in response.json()["problems"]] == ["id"]


def test_notes_as_csv_have_the_names_that_they_are_given(client: TestClient) -> None:
    """So a second one can be uploaded as well."""
    kind = {"content-type": "text/csv"}
    for name in ("tuesday", "wednesday"):
        made = client.post("/api/v1/deliveries", params={"name": name}, content=NOTE, headers=kind)
        assert [view["id"] for view in made.json()] == [name]


def test_a_product_is_changed_by_whoever_has_seen_it(client: TestClient) -> None:
    """New ones need no version; the pictures have nothing to do with it."""
    body = {"name": "biscuits", "size": [0.3, 0.2, 0.25], "mass": 4.0}
    path = "/api/v1/products/4006381333931"
    assert client.put(path, json=body, headers={"if-match": "*"}).status_code == 404
    made = client.put(path, json=body)
    assert made.status_code == 200
    assert client.put(path, json=body).status_code == 428
    seen = {"if-match": made.headers["etag"]}
    changed = client.put(path, json={**body, "mass": 5.0}, headers=seen)
    assert changed.status_code == 200
    assert client.put(path, json=body, headers=seen).status_code == 412
    places = {"places": ["trolley_1/level_1"]}
    assert client.put(f"{path}/places", json=places).status_code == 428
    assert client.put(f"{path}/places", json=places, headers=seen).status_code == 412
    fresh = {"if-match": client.get(path).headers["etag"]}
    assert fresh["if-match"] == changed.headers["etag"]
    put = client.put(f"{path}/places", json=places, headers=fresh)
    assert put.json()["places"] == ["trolley_1/level_1"]
    listed = client.get("/api/v1/products", params={"search": "biscuits"}).json()
    assert f'"{listed[0]["version"]}"' == put.headers["etag"]
