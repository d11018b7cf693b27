"""The journal as server-sent events: how it ends."""

import asyncio
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from sites import PER_RUN, REACHED, Event, FakeEvents, site_over

from depal.server.api import build_app
from depal.server.api.routes import journal
from depal.server.site import Site


@pytest.fixture
def site(tmp_path: Path) -> Site:
    """With some events."""
    return site_over(tmp_path)


@pytest.fixture
def client(site: Site) -> Iterator[TestClient]:
    """A service."""
    _, secret = site.tokens.add("till", 1.0)
    with TestClient(build_app(site, REACHED)) as client:
        client.headers["authorization"] = f"Bearer {secret}"
        yield client


def listen(client: TestClient, after: int, **params: float) -> str:
    """All that a stream tells until it ends."""
    headers = {"last-event-id": str(after)}
    return client.get("/api/v1/events", params=params, headers=headers).text


def test_a_stream_that_has_nothing_to_tell_says_so(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """So that nothing in between believes it dead."""
    monkeypatch.setattr(journal, "BEATS", 0.0)
    assert ": still here" in listen(client, PER_RUN + 5, wait=0.05)


def test_a_stream_ends_with_the_right_to_read_it(
    site: Site, client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A token that was revoked meanwhile: what happens afterwards is not told."""
    monkeypatch.setattr(journal, "BEATS", 0.0)
    tell = site.events.after

    def revoked_meanwhile(sequence: int, limit: int) -> tuple[Event, ...]:
        site.tokens.revoke(site.tokens.list()[0].id)
        found = tell(sequence, limit)
        more = Event(PER_RUN + 6, 1, 6.0, "Secret", {})
        site.events.events = (*site.events.events, more)  # type: ignore[attr-defined]
        return found

    monkeypatch.setattr(FakeEvents, "after", lambda _, *args: revoked_meanwhile(*args))
    told = listen(client, PER_RUN + 3)  # would go on for an hour
    assert f"id: {PER_RUN + 5}" in told
    assert "Secret" not in told


def test_no_more_streams_than_can_be_served(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One too many is told when to come back, and each that ends makes room."""
    monkeypatch.setattr(journal, "MOST", 1)
    for _ in range(3):
        assert "id:" in listen(client, PER_RUN, wait=0.0)
    monkeypatch.setattr(journal, "MOST", 0)
    response = client.get("/api/v1/events", params={"wait": 0})
    assert response.status_code == 429
    assert response.headers["retry-after"] == "10"


def test_who_reads_too_slowly_is_let_go(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Their socket takes nothing any more: the answer is broken off, unfinished."""
    monkeypatch.setattr(journal, "STALLED", 0.01)
    app = client.app
    assert isinstance(app, FastAPI)
    sent: list[dict[str, Any]] = []
    asked: list[dict[str, Any]] = [{"type": "http.request", "body": b"", "more_body": False}]

    async def stuck(message: Any) -> None:  # noqa: ANN401 - any ASGI message
        if len(sent) == 2:
            await asyncio.Event().wait()
        sent.append(message)

    async def silent() -> dict[str, Any]:
        if asked:
            return asked.pop()
        await asyncio.Event().wait()
        raise AssertionError

    headers = {**client.headers, "host": "localhost", "last-event-id": str(PER_RUN)}
    scope = {
        "type": "http",
        "asgi": {"version": "3.0", "spec_version": "2.3"},
        "method": "GET",
        "path": "/api/v1/events",
        "query_string": b"",
        "headers": [(key.lower().encode(), value.encode()) for key, value in headers.items()],
    }
    asyncio.run(asyncio.wait_for(app(scope, silent, stuck), 10.0))
    assert sent[0]["status"] == 200
    assert sent[-1].get("more_body") is True
