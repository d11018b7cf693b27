"""The cell: state, trees, why, picture, journal, commands, settings."""

import asyncio
import time
from collections.abc import AsyncIterator
from typing import Annotated, Any

import msgspec
from fastapi import APIRouter, Header, Path, Query, Request
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response, StreamingResponse

from depal.server.api.bodies import NewSettings, Start
from depal.server.api.contents import gives
from depal.server.api.encoding import said, serves, version_in, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers
from depal.server.cellstate import CellState, TaskTree
from depal.server.events import Event
from depal.server.records import Kept
from depal.server.roles import Principal
from depal.server.site import Site
from depal.server.usecases import working as cases

LOOKING = 0.03
"""New events are looked for so often [s]."""

BEATS = 10.0
"""A stream that has nothing to tell says so after so long [s]."""

LONGEST = 3600.0
"""A stream ends after so long; browsers come back by themselves [s]."""

NAME = Annotated[str, Path(min_length=1, max_length=100)]


def working(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    del exposure
    _reading(router, site)
    _commands(router, site)
    _settings(router, site)
    _journal(router, site)


def _reading(router: APIRouter, site: Site) -> None:
    @router.get("/state", response_model=CellState, responses=answers(), operation_id="see_state")
    @serves(cases.see_state)
    def see_state(request: Request) -> Response:
        """The state of the cell now; its ETag is its version."""
        state = cases.see_state(site, who_asks(request))
        if request.headers.get("if-none-match") == f'"{state.version}"':
            return Response(status_code=304, headers={"ETag": f'"{state.version}"'})
        return said(state, version=state.version)

    @router.get(
        "/trees", response_model=list[TaskTree], responses=answers(), operation_id="see_trees"
    )
    @serves(cases.see_trees)
    def see_trees(request: Request) -> Response:
        """The executive's task trees now."""
        return said(cases.see_trees(site, who_asks(request)))

    @router.get(
        "/boxes/{box}/why", response_model=str, responses=answers(404), operation_id="ask_why"
    )
    @serves(cases.ask_why)
    def ask_why(request: Request, box: NAME) -> Response:
        """Why the last selection took a box, or did not."""
        return said(cases.ask_why(site, who_asks(request), box))

    @router.get(
        "/picture",
        response_class=Response,
        responses={200: {"content": {"image/jpeg": {}}}, **answers(404)},
        operation_id="see_picture",
    )
    @serves(cases.see_picture)
    @gives("image/jpeg")
    def see_picture(request: Request) -> Response:
        """The last camera picture with what was seen in it."""
        picture = cases.see_picture(site, who_asks(request))
        return Response(picture, media_type="image/jpeg", headers={"Cache-Control": "no-store"})


def _commands(router: APIRouter, site: Site) -> None:
    @router.post(
        "/commands/start", response_model=CellState, responses=answers(404), operation_id="start"
    )
    @serves(cases.start)
    def start(request: Request, body: Start | None = None) -> Response:
        """Start a delivery of the queue, or go on after a stop, a hold or a restart."""
        delivery = None if body is None else body.delivery
        return _state(cases.start(site, who_asks(request), delivery))

    @router.post(
        "/commands/hold", response_model=CellState, responses=answers(), operation_id="hold"
    )
    @serves(cases.hold)
    def hold(request: Request) -> Response:
        """Nothing new begins; the arm finishes what it does."""
        return _state(cases.hold(site, who_asks(request)))

    @router.post(
        "/commands/resume", response_model=CellState, responses=answers(), operation_id="resume"
    )
    @serves(cases.resume)
    def resume(request: Request) -> Response:
        """Go on after a hold."""
        return _state(cases.resume(site, who_asks(request)))

    @router.post(
        "/commands/stop", response_model=CellState, responses=answers(), operation_id="stop"
    )
    @serves(cases.stop_after_box)
    def stop(request: Request) -> Response:
        """Finish the box in hand, then stop."""
        return _state(cases.stop_after_box(site, who_asks(request)))


def _state(state: CellState) -> Response:
    return said(state, version=state.version)


def _settings(router: APIRouter, site: Site) -> None:
    @router.get("/settings", response_model=Kept, responses=answers(), operation_id="see_settings")
    @serves(cases.see_settings)
    def see_settings(request: Request) -> Response:
        """The settings of the cell."""
        kept = cases.see_settings(site, who_asks(request))
        return said(kept, version=kept.version)

    @router.put(
        "/settings",
        response_model=Kept,
        responses=answers(412, 428),
        operation_id="change_settings",
    )
    @serves(cases.change_settings)
    def change_settings(
        request: Request,
        body: NewSettings,
        if_match: Annotated[str | None, Header()] = None,
    ) -> Response:
        """Change the settings of the cell, each within its bounds."""
        del if_match
        version = version_in(request)
        kept = cases.change_settings(site, who_asks(request), **body.model_dump(), version=version)
        return said(kept, version=kept.version)


def _journal(router: APIRouter, site: Site) -> None:
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

    @router.get("/events", include_in_schema=False)
    @serves(cases.read_events)
    async def stream(
        request: Request,
        last_event_id: Annotated[str | None, Header()] = None,
        wait: Annotated[float, Query(ge=0.0, le=LONGEST)] = LONGEST,
    ) -> Response:
        """The journal as server-sent events, from Last-Event-ID on or from now."""
        who = who_asks(request)
        known = await run_in_threadpool(cases.last_event, site, who)
        if last_event_id is not None and last_event_id.isascii() and last_event_id.isdigit():
            known = int(last_event_id[:19])
        told = _told(site, who, known, wait)
        headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
        return StreamingResponse(told, media_type="text/event-stream", headers=headers)


async def _told(site: Site, who: Principal | None, after: int, wait: float) -> AsyncIterator[bytes]:
    """Events as they come; who reads too slowly is not waited for: the server holds none back."""
    until, spoken = time.monotonic() + wait, time.monotonic()
    yield b"retry: 1000\n\n"
    while True:
        newest = site.events.last
        if newest > after:
            for event in await run_in_threadpool(cases.read_events, site, who, after, 100):
                after = event.sequence
                yield _line(event)
            spoken = time.monotonic()
            continue
        now = time.monotonic()
        if now >= until:
            return
        if now - spoken > BEATS:
            spoken = now
            yield b": still here\n\n"
        await asyncio.sleep(LOOKING)


def _line(event: Event) -> bytes:
    body: Any = msgspec.json.encode(event)
    head = f"id: {event.sequence}\nevent: {event.kind}\ndata: ".encode()
    return head + bytes(body) + b"\n\n"
