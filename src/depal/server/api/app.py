"""The API as one FastAPI app; screen and gate are put around it."""

from fastapi import APIRouter, FastAPI

from depal import __version__
from depal.server.api.answers import install
from depal.server.api.exposure import Exposure
from depal.server.api.gate import Gate
from depal.server.api.routes.journal import journal
from depal.server.api.routes.managing import managing
from depal.server.api.routes.store import store
from depal.server.api.routes.wanting import wanting
from depal.server.api.routes.working import working
from depal.server.site import Site

ROOT = "/api/v1"

TEXT = """What a store's system and a screen can ask of a depalletizing cell.

People sign in and get a cookie; services send `Authorization: Bearer depal_...`. Everything that
is no result is `application/problem+json`. What can be changed has an ETag; a change names it in
`If-Match`. `GET /api/v1/events` tells the journal as server-sent events.
"""


def build_app(site: Site, exposure: Exposure | None = None) -> FastAPI:
    """The API of a site.

    Args:
        site: what it works with.
        exposure: how it is reached.
    """
    reached = exposure or Exposure()
    app = FastAPI(
        title="depal",
        version=__version__,
        description=TEXT,
        docs_url=None,
        redoc_url=None,
        openapi_url="/openapi.json",
    )
    router = APIRouter(prefix=ROOT)
    for routes in (working, journal, wanting, store, managing):
        routes(router, site, reached)
    app.include_router(router)
    install(app)
    app.add_middleware(Gate, site=site, exposure=reached, routes=router.routes)
    return app
