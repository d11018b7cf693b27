"""The journal: in pages, and as server-sent events."""

import asyncio
import time
from collections.abc import AsyncGenerator, Callable
from contextlib import aclosing, suppress
from typing import Annotated, Any

import msgspec
from fastapi import APIRouter, Header, Query, Request
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response, StreamingResponse
from starlette.types import Message, Send

from depal.server.api.contents import gives
from depal.server.api.encoding import said, serves, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers
from depal.server.events import Event
from depal.server.problems import Answer, TooMany
from depal.server.roles import Principal
from depal.server.site import Site
from depal.server.usecases import working as cases

LOOKING = 0.03
"""New events are looked for so often [s]."""

BEATS = 10.0
"""So often a stream that has nothing to tell says so, and who reads is looked at again [s]."""

STALLED = 20.0
"""Who takes nothing for so long is not waited for any more [s]."""

LONGEST = 3600.0
"""A stream ends after so long; browsers come back by themselves [s]."""

MOST = 64
"""So many streams are open at once at the most."""

KIND = "text/event-stream"


def journal(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    del exposure
    _pages(router, site)
    _stream(router, site)


def _pages(router: APIRouter, site: Site) -> None:
    @router.get(
        "/journal", response_model=list[Event], responses=answers(), operation_id="read_events"
    )
    @serves(cases.read_events)
    def read_events(
        request: Request,
        after: Annotated[int, Query(ge=0, le=2**62)] = 0,
        limit: Annotated[int, Query(ge=1, le=500)] = 100,
    ) -> Response:
        """The events of the journal after a number."""
        return said(cases.read_events(site, who_asks(request), after, limit))


def _stream(router: APIRouter, site: Site) -> None:
    telling = _Count()

    @router.get(
        "/events",
        response_class=Response,
        responses={200: {"content": {KIND: {"schema": {"type": "string"}}}}, **answers(429)},
        operation_id="stream_events",
    )
    @serves(cases.read_events)
    @gives(KIND)
    async def stream_events(
        request: Request,
        last_event_id: Annotated[str | None, Header(max_length=100)] = None,
        wait: Annotated[float, Query(ge=0.0, le=LONGEST)] = LONGEST,
    ) -> Response:
        """The journal as server-sent events, from Last-Event-ID on or from now, for `wait` seconds.

        What has no number as Last-Event-ID begins now.
        """
        if telling.now >= MOST:
            raise TooMany(f"{MOST} streams are open already", after=BEATS)
        known = await run_in_threadpool(cases.last_event, site, who_asks(request))
        if last_event_id is not None and last_event_id.isascii() and last_event_id.isdigit():
            known = min(int(last_event_id[:20]), 2**62)
        reader = _Reader(site, who_asks(request), request.scope["principal_now"], telling)
        headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
        return _Hurried(reader.told(known, wait), headers)


class _Count:
    """Of the streams that are open."""

    def __init__(self) -> None:
        self.now = 0


class _Reader:
    """Whoever is told the events; the server holds none of them back for anybody."""

    def __init__(
        self,
        site: Site,
        who: Principal | None,
        again: Callable[[], Principal | None],
        telling: _Count,
    ) -> None:
        """Nothing is told yet; `again` says who it is by now."""
        self._site, self._who, self._again, self._telling = site, who, again, telling

    async def told(self, after: int, wait: float) -> AsyncGenerator[bytes]:
        """Events after a number as they come."""
        self._telling.now += 1
        try:
            until = spoken = looked = time.monotonic()
            until += wait
            yield b"retry: 1000\n\n"
            while True:
                for event in await self._after(after):
                    after, spoken = event.sequence, time.monotonic()
                    yield _line(event)
                now = time.monotonic()
                if now - looked >= BEATS:
                    looked = now
                    if not await self._still_good():
                        return
                if self._site.events.last > after:
                    continue
                if now >= until:
                    return
                if now - spoken >= BEATS:
                    spoken = now
                    yield b": still here\n\n"
                await asyncio.sleep(LOOKING)
        finally:
            self._telling.now -= 1

    async def _after(self, sequence: int) -> tuple[Event, ...]:
        if self._site.events.last <= sequence:
            return ()
        return await run_in_threadpool(cases.read_events, self._site, self._who, sequence, 100)

    async def _still_good(self) -> bool:
        """Whether they are still signed in as who they were."""
        try:
            return await run_in_threadpool(self._again) == self._who
        except Answer:
            return False


class _Hurried(StreamingResponse):
    """A response to a reader who must keep up."""

    def __init__(self, told: AsyncGenerator[bytes], headers: dict[str, str]) -> None:
        self._told = told
        super().__init__(told, headers=headers, media_type=KIND)

    async def stream_response(self, send: Send) -> None:
        """Sends it, or breaks off: then the server closes the connection."""

        async def hurried(message: Message) -> None:
            async with asyncio.timeout(STALLED):
                await send(message)

        async with aclosing(self._told):
            with suppress(TimeoutError):
                await super().stream_response(hurried)


def _line(event: Event) -> bytes:
    body: Any = msgspec.json.encode(event)
    head = f"id: {event.sequence}\nevent: {event.kind}\ndata: ".encode()
    return head + bytes(body) + b"\n\n"
