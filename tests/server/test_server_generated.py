"""Generated requests, and what hostile clients send."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from sites import LINE, PASSWORD, REACHED, site_over, upload

from depal.server.api import build_app
from depal.server.site import Site

SCRIPT = Path(__file__).parent.parent.parent / "scripts" / "fuzz_api.py"

HOSTILE = (
    "<script>alert(1)</script>",
    "'; DROP TABLE products; --",
    "../../../etc/passwd",
    "\u202egnp.exe",
    "a" * 100,
    "{{7*7}}${7*7}",
    "\U0001f4e6 caffè",
)


@pytest.fixture
def site(tmp_path: Path) -> Site:
    """Busy, with people."""
    return site_over(tmp_path)


@pytest.fixture
def client(site: Site) -> Iterator[TestClient]:
    """Signed in as an integrator."""
    with TestClient(build_app(site, REACHED), raise_server_exceptions=False) as client:
        body = {"name": "ines", "password": PASSWORD}
        assert client.post("/api/v1/sign-in", json=body).status_code == 200
        client.headers["origin"] = "http://testserver"
        yield client


@pytest.mark.slow
def test_generated_requests_meet_no_server_error_and_no_hang() -> None:
    """About 3,000, in sequences too; every operation succeeds at least 20 times."""
    command = [sys.executable, str(SCRIPT), "--requests", "2200"]
    done = subprocess.run(  # noqa: S603 - our own script
        command, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_name_is_kept_as_it_is_and_harms_nothing(client: TestClient, name: str) -> None:
    """It is text: in the answer, in a search, in the audit log."""
    body = {"name": name, "size": [0.3, 0.2, 0.25], "mass": 4.0}
    put = client.put("/api/v1/products/4006381333931", json=body)
    assert put.status_code == 200
    assert put.json()["name"] == name
    found = client.get("/api/v1/products", params={"search": name}).json()
    assert [product["name"] for product in found] == [name]
    assert client.get("/api/v1/audit/verify").json()["whole"] is True


def test_a_hundred_megabytes_are_refused_before_they_are_read(client: TestClient) -> None:
    """By what the header says, and by counting where it says nothing."""
    sent = []

    def flood() -> Iterator[bytes]:
        for _ in range(1600):
            sent.append(1)
            yield b" " * 65536

    kind = {"content-type": "application/json"}
    response = client.post("/api/v1/deliveries", content=flood(), headers=kind)
    assert response.status_code == 413
    big = client.post("/api/v1/deliveries", content=b" " * (6 * 2**20), headers=kind)
    assert big.status_code == 413
    assert big.headers["content-type"] == "application/problem+json"
    small = client.post("/api/v1/requests", content=b" " * 70_000, headers=kind)
    assert small.status_code == 413


def test_a_delivery_that_cannot_be_used_is_told_whole(client: TestClient) -> None:
    """Everything that is wrong, with where it is; nothing is queued."""
    before = client.get("/api/v1/deliveries").json()
    text = upload("bad").replace(f'"mass": {LINE.product.mass}', '"mass": -1', 1)
    text = text.replace('"count": ', '"count": 0.5, "x": ', 1)
    kind = {"content-type": "application/json"}
    response = client.post("/api/v1/deliveries", content=text, headers=kind)
    assert response.status_code == 422
    assert len(response.json()["problems"]) >= 2
    assert client.get("/api/v1/deliveries").json() == before


def test_a_request_is_answered_by_what_is_so(client: TestClient) -> None:
    """Stored already, not there, unknown, too much: each with its reason."""

    def status(**body: object) -> tuple[int, str]:
        response = client.post("/api/v1/requests", json=body)
        return response.status_code, response.json().get("detail", "")

    assert status(box="b2") == (
        409,
        "box 'b2' is stored already: it stands in trolley_1/level_1",
    )
    assert status(box="b9") == (404, "no box 'b9' stands on the pallet; there is: b1")
    assert status(gtin="999")[0] == 404
    assert status(gtin=LINE.product.gtin, box="b1")[0] == 422
    assert status(gtin=LINE.product.gtin, priority=1.5)[0] == 422
    assert status(gtin=LINE.product.gtin, due="2020-01-01T00:00:00Z")[0] == 422
    assert status(gtin=LINE.product.gtin, due_in=1.0, due="2030-01-01T00:00:00Z")[0] == 422
    assert status(box="b1")[0] == 201


def test_the_same_key_asks_once_and_for_one_thing(client: TestClient, site: Site) -> None:
    """Sent again it gets the same answer; for something else it is refused."""
    headers = {"idempotency-key": "order 66"}
    body = {"gtin": LINE.product.gtin, "priority": 0.4}
    first = client.post("/api/v1/requests", json=body, headers=headers)
    again = client.post("/api/v1/requests", json=body, headers=headers)
    assert first.status_code == again.status_code == 201
    assert first.json() == again.json()
    other = client.post("/api/v1/requests", json={**body, "priority": 0.5}, headers=headers)
    assert other.status_code == 422
    keys = [view.key for view in site.requests.list()]
    assert len(keys) == len(set(keys)) == 2


def test_a_change_names_the_version_that_it_changes(client: TestClient) -> None:
    """Without one 428, with an old one 412, with the right one 200 and a new one."""
    made = client.post("/api/v1/requests", json={"gtin": LINE.product.gtin})
    path, etag = f"/api/v1/requests/{made.json()['key']}", made.headers["etag"]
    body = {"priority": 0.9}
    assert client.patch(path, json=body).status_code == 428
    changed = client.patch(path, json=body, headers={"if-match": etag})
    assert changed.status_code == 200
    assert changed.headers["etag"] != etag
    assert client.patch(path, json=body, headers={"if-match": etag}).status_code == 412
    assert client.delete(path, headers={"if-match": etag}).status_code == 412
    assert client.delete(path, headers={"if-match": changed.headers["etag"]}).status_code == 200
    gone = client.delete(path, headers={"if-match": "*"})
    assert gone.status_code == 409
    assert "cancelled by ines" in gone.json()["detail"]


def test_of_two_people_who_answer_one_question_the_first_is_heard(client: TestClient) -> None:
    """The second is told who has answered what."""
    path = "/api/v1/answers/1/product/b1/0-1"
    assert client.put(path, json={"choice": "none of them"}).status_code == 422
    assert client.put(path, json={"choice": "this"}).status_code == 200
    client.post("/api/v1/sign-in", json={"name": "otto", "password": PASSWORD})
    second = client.put(path, json={"choice": "that"})
    assert second.status_code == 409
    assert second.json()["detail"] == "ines has answered this question already: this"


def test_events_go_on_after_the_last_one_that_was_heard(client: TestClient) -> None:
    """Server-sent, with their numbers; a stream that has to end ends."""
    response = client.get(
        "/api/v1/events", params={"wait": 0}, headers={"last-event-id": str(10**9 + 3)}
    )
    assert response.headers["content-type"].startswith("text/event-stream")
    lines = [line for line in response.text.splitlines() if line.startswith("id: ")]
    assert lines == [f"id: {10**9 + 4}", f"id: {10**9 + 5}"]


def test_state_has_a_version_and_is_not_sent_twice(client: TestClient) -> None:
    """If-None-Match."""
    first = client.get("/api/v1/state")
    assert first.status_code == 200
    again = client.get("/api/v1/state", headers={"if-none-match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
