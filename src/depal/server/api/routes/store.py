"""Deliveries, products, pictures, places, stock."""

from typing import Annotated

from fastapi import APIRouter, Header, Path, Query, Request
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response

from depal.errors import Problem
from depal.server.api.bodies import Assignment, NewProduct, Position
from depal.server.api.contents import gives, uploads
from depal.server.api.encoding import said, serves, version_in, who_asks
from depal.server.api.exposure import Exposure
from depal.server.api.routes.documented import answers, leads
from depal.server.problems import Unusable
from depal.server.records import PictureView, QueuedView
from depal.server.records.products import NEW
from depal.server.site import Site
from depal.server.usecases import deliveries as cases

NAME = Annotated[str, Path(min_length=1, max_length=100)]

FILE = Annotated[
    str,
    Query(min_length=1, max_length=90, description="the name of a delivery that comes as CSV"),
]

UPLOAD = {
    "requestBody": {
        "required": True,
        "content": {
            "application/json": {"schema": {"type": ["object", "array"]}},
            "text/csv": {"schema": {"type": "string"}},
        },
    }
}

PICTURE = {
    "requestBody": {
        "required": True,
        "content": {
            "image/png": {"schema": {"type": "string", "format": "binary"}},
            "image/jpeg": {"schema": {"type": "string", "format": "binary"}},
        },
    }
}

DELIVERY = {"get_delivery": "name", "move_delivery": "name", "cancel_delivery": "name"}

PRODUCT = {
    "get_product": "gtin",
    "put_product": "gtin",
    "assign_product": "gtin",
    "put_picture": "gtin",
    "get_picture": "gtin",
}

MATCH = Annotated[str | None, Header(description="the ETag of what is changed, or *")]

FACE = Annotated[str, Path(pattern="^(front|back|left|right|top|bottom)$")]


def store(router: APIRouter, site: Site, exposure: Exposure) -> None:
    """Adds the routes over a site."""
    del exposure
    _deliveries(router, site)
    _queue(router, site)
    _products(router, site)
    _pictures(router, site)
    _stock(router, site)


async def _text(request: Request, name: str) -> tuple[str, str]:
    """An uploaded file and its name: a note as CSV has no other one."""
    kind = request.headers.get("content-type", "")
    body = await request.body()
    try:
        text = body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unusable("the file is no text", [Problem("body", str(error), "UTF-8")]) from error
    return text, f"{name}.csv" if kind.startswith("text/csv") else f"{name}.json"


def _deliveries(router: APIRouter, site: Site) -> None:
    @router.post(
        "/deliveries",
        response_model=list[QueuedView],
        status_code=201,
        responses=answers() | leads(201, "/0/id", **DELIVERY),
        operation_id="add_deliveries",
        openapi_extra=UPLOAD,
    )
    @serves(cases.add_deliveries)
    @uploads("application/json", "text/csv")
    async def add_deliveries(request: Request, name: FILE = "upload") -> Response:
        """Check an uploaded file of deliveries and add them to the end of the queue."""
        text, file = await _text(request, name)
        who = who_asks(request)
        return said(await run_in_threadpool(cases.add_deliveries, site, who, text, file), 201)

    @router.post(
        "/deliveries/check",
        response_model=list[str],
        responses=answers(),
        operation_id="check_deliveries",
        openapi_extra=UPLOAD,
    )
    @serves(cases.check_deliveries)
    @uploads("application/json", "text/csv")
    async def check_deliveries(request: Request, name: FILE = "upload") -> Response:
        """Check a file of deliveries without adding it."""
        text, file = await _text(request, name)
        who = who_asks(request)
        return said(await run_in_threadpool(cases.check_deliveries, site, who, text, file))

    @router.get(
        "/deliveries",
        response_model=list[QueuedView],
        responses=answers(404) | leads(200, "/0/id", **DELIVERY),
        operation_id="list_deliveries",
    )
    @serves(cases.list_deliveries)
    def list_deliveries(
        request: Request,
        after: Annotated[str | None, Query(max_length=100)] = None,
        limit: Annotated[int, Query(ge=1, le=500)] = 100,
    ) -> Response:
        """The queue of deliveries, then those that are done, the newest first."""
        return said(cases.list_deliveries(site, who_asks(request), after, limit))


def _queue(router: APIRouter, site: Site) -> None:
    @router.get(
        "/deliveries/{name:path}",
        response_model=QueuedView,
        responses=answers(404),
        operation_id="get_delivery",
    )
    @serves(cases.get_delivery)
    def get_delivery(request: Request, name: NAME) -> Response:
        """A delivery."""
        view = cases.get_delivery(site, who_asks(request), name)
        return said(view, version=view.version)

    @router.delete(
        "/deliveries/{name:path}",
        response_model=QueuedView,
        responses=answers(404, 412, 428),
        operation_id="cancel_delivery",
    )
    @serves(cases.cancel_delivery)
    def cancel_delivery(
        request: Request, name: NAME, if_match: Annotated[str | None, Header()] = None
    ) -> Response:
        """Take a delivery out of the queue."""
        del if_match
        view = cases.cancel_delivery(site, who_asks(request), name, version_in(request))
        return said(view, version=view.version)

    @router.put(
        "/deliveries/{name:path}/position",
        response_model=QueuedView,
        responses=answers(404, 412, 428),
        operation_id="move_delivery",
    )
    @serves(cases.move_delivery)
    def move_delivery(
        request: Request,
        name: NAME,
        body: Position,
        if_match: Annotated[str | None, Header()] = None,
    ) -> Response:
        """Move a delivery to another position in the queue."""
        del if_match
        version = version_in(request)
        view = cases.move_delivery(site, who_asks(request), name, body.position, version)
        return said(view, version=view.version)


def _products(router: APIRouter, site: Site) -> None:
    @router.get(
        "/products",
        response_model=list[cases.ProductView],
        responses=answers() | leads(200, "/0/gtin", **PRODUCT),
        operation_id="list_products",
    )
    @serves(cases.list_products)
    def list_products(
        request: Request,
        search: Annotated[str, Query(max_length=100)] = "",
        after: Annotated[str, Query(max_length=100)] = "",
        limit: Annotated[int, Query(ge=1, le=500)] = 100,
    ) -> Response:
        """The products that the store knows, by name or number."""
        return said(cases.list_products(site, who_asks(request), search, after, limit))

    @router.get(
        "/products/{gtin}",
        response_model=cases.ProductView,
        responses=answers(404),
        operation_id="get_product",
    )
    @serves(cases.get_product)
    def get_product(request: Request, gtin: NAME) -> Response:
        """A product with its places and pictures."""
        view = cases.get_product(site, who_asks(request), gtin)
        return said(view, version=view.version)

    @router.put(
        "/products/{gtin}",
        response_model=cases.ProductView,
        responses=answers(404, 412, 428) | leads(200, "/gtin", **PRODUCT),
        operation_id="put_product",
    )
    @serves(cases.put_product)
    def put_product(
        request: Request, gtin: NAME, body: NewProduct, if_match: MATCH = None
    ) -> Response:
        """Add a product, or change what is known of it: then with If-Match."""
        who = who_asks(request)
        version = NEW if if_match is None else version_in(request)
        if version is None:
            version = cases.get_product(site, who, gtin).version
        view = cases.put_product(site, who, gtin, body.name, body.size, body.mass, version)
        return said(view, version=view.version)

    @router.put(
        "/products/{gtin}/places",
        response_model=cases.ProductView,
        responses=answers(404, 412, 428),
        operation_id="assign_product",
    )
    @serves(cases.assign_product)
    def assign_product(
        request: Request, gtin: NAME, body: Assignment, if_match: MATCH = None
    ) -> Response:
        """Say where a product belongs, best first."""
        del if_match
        version, places = version_in(request), tuple(body.places)
        view = cases.assign_product(site, who_asks(request), gtin, places, version)
        return said(view, version=view.version)


def _pictures(router: APIRouter, site: Site) -> None:
    @router.put(
        "/products/{gtin}/pictures/{face}",
        response_model=PictureView,
        responses=answers(404),
        operation_id="put_picture",
        openapi_extra=PICTURE,
    )
    @serves(cases.put_picture)
    @uploads("image/png", "image/jpeg")
    async def put_picture(request: Request, gtin: NAME, face: FACE) -> Response:
        """Upload a picture of a product's face, PNG or JPEG."""
        body = await request.body()
        who = who_asks(request)
        return said(await run_in_threadpool(cases.put_picture, site, who, gtin, face, body))

    @router.get(
        "/products/{gtin}/pictures/{face}",
        response_class=Response,
        responses={200: {"content": {"image/png": {}, "image/jpeg": {}}}, **answers(404)},
        operation_id="get_picture",
    )
    @serves(cases.get_picture)
    @gives("image/png", "image/jpeg")
    def get_picture(request: Request, gtin: NAME, face: FACE) -> Response:
        """A picture of a product's face."""
        view, body = cases.get_picture(site, who_asks(request), gtin, face)
        return Response(body, media_type=view.type)


def _stock(router: APIRouter, site: Site) -> None:
    @router.get(
        "/places",
        response_model=list[cases.PlaceView],
        responses=answers(),
        operation_id="list_places",
    )
    @serves(cases.list_places)
    def list_places(request: Request) -> Response:
        """The compartments of the cell."""
        return said(cases.list_places(site, who_asks(request)))

    @router.get(
        "/stock",
        response_model=list[cases.StockLine],
        responses=answers(),
        operation_id="see_stock",
    )
    @serves(cases.see_stock)
    def see_stock(request: Request) -> Response:
        """How many cases of which product went into each place."""
        return said(cases.see_stock(site, who_asks(request)))
