"""The cell: state, trees, why, picture, commands, settings."""

from typing import Annotated

from fastapi import APIRouter, Header, Path, Request
from starlette.responses import Response

from depal.server.api.bodies import NewSettings, Start
from depal.server.api.contents import gives
from depal.server.api.encoding import said, serves, version_in, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers
from depal.server.cellstate import CellState, TaskTree
from depal.server.records import Kept
from depal.server.site import Site
from depal.server.usecases import working as cases

NAME = Annotated[str, Path(min_length=1, max_length=100)]


def working(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    del exposure
    _reading(router, site)
    _commands(router, site)
    _settings(router, site)


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
