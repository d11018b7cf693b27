"""Before anything else is looked at: host, origin, size, and who is asking for what."""

from collections.abc import Callable, Sequence
from urllib.parse import urlsplit

from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.routing import BaseRoute, Match
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from depal.server.api.answers import answered, problem
from depal.server.api.exposure import Exposure
from depal.server.problems import Answer, Forbidden, SignInNeeded, TooLarge, WrongType
from depal.server.roles import Principal
from depal.server.site import Site
from depal.server.usecases.registry import MARK, UseCase

PREFIX = "/api/"

SAFE = {"GET", "HEAD", "OPTIONS"}

USUAL, LARGE = 64 * 1024, 5 * 2**20 + 4096
"""Of a body [byte]: usually, and where files are uploaded."""

BEARER = "bearer "

API_POLICY = "default-src 'none'; frame-ancestors 'none'"

SCREEN_POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self' ws: wss:; worker-src 'self' blob:; object-src 'none'; base-uri 'self'; "
    "form-action 'self'; frame-ancestors 'none'"
)

HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "x-frame-options": "DENY",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}


def uploads(function: Callable[..., object]) -> Callable[..., object]:
    """Marks an endpoint that takes files."""
    function.uploads = True  # type: ignore[attr-defined]
    return function


class Gate:
    """Middleware around the whole app."""

    def __init__(
        self, app: ASGIApp, site: Site, exposure: Exposure, routes: Sequence[BaseRoute]
    ) -> None:
        """Before an app.

        Args:
            app: everything behind it.
            site: knows people.
            exposure: how the site is reached.
            routes: of the API, each with its use case.
        """
        self._app, self._site, self._exposure, self._routes = app, site, exposure, routes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One request, or one websocket."""
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return
        connection = HTTPConnection(scope)
        refusal = self._foreign(connection, scope)
        if refusal is not None:
            await _refuse(refusal, scope, receive, send)
            return
        if scope["type"] == "websocket":
            await self._app(scope, receive, send)
            return
        is_api = scope["path"].startswith(PREFIX)
        telling = _with_headers(send, API_POLICY if is_api else SCREEN_POLICY)
        if not is_api:
            await self._app(scope, receive, telling)
            return
        await self._api(connection, scope, receive, telling)

    async def _api(
        self, connection: HTTPConnection, scope: Scope, receive: Receive, send: Send
    ) -> None:
        endpoint, known = self._endpoint(scope)
        try:
            who = await run_in_threadpool(self._who, connection)
            _check(endpoint, who, known=known)
            limit = LARGE if getattr(endpoint, "uploads", False) else USUAL
            _check_body(connection, scope["method"], limit)
        except Answer as answer:
            await answered(answer)(scope, receive, send)
            return
        scope["principal"] = who
        await self._app(scope, _measured(receive, limit), send)

    def _endpoint(self, scope: Scope) -> tuple[Callable[..., object] | None, bool]:
        """What a request is for, and whether the path is known under another method."""
        known = False
        for route in self._routes:
            match, child = route.matches(scope)
            if match is Match.FULL:
                return child.get("endpoint"), True
            known = known or match is Match.PARTIAL
        return None, known

    def _who(self, connection: HTTPConnection) -> Principal | None:
        """Who is asking.

        Raises:
            SignInNeeded: a token or a session that is not good.
        """
        header = connection.headers.get("authorization", "")
        if header:
            if not header.lower().startswith(BEARER):
                raise SignInNeeded("expected a bearer token")
            who = self._site.tokens.who(header[len(BEARER) :].strip())
            if who is None:
                raise SignInNeeded("this token is not good, or not any more")
            return who
        secret = connection.cookies.get(self._exposure.cookie)
        return None if not secret else self._site.sessions.who(secret)

    def _foreign(self, connection: HTTPConnection, scope: Scope) -> Response | None:
        """Whether another site is behind it (RELIABILITY, S2)."""
        host = connection.headers.get("host", "")
        if not self._exposure.allows(host):
            return problem(421, "Not this host", f"this cell is not reached as {host[:80]!r}")
        unsafe = scope["type"] == "websocket" or scope["method"] not in SAFE
        if not unsafe or connection.headers.get("authorization"):
            return None
        fetched = connection.headers.get("sec-fetch-site")
        origin = connection.headers.get("origin")
        if fetched is not None:
            same = fetched in {"same-origin", "none"}
        elif origin is not None:
            same = urlsplit(origin).netloc == host
        else:
            same = not connection.cookies.get(self._exposure.cookie)  # no browser, nothing to steal
        if same:
            return None
        return answered(Forbidden("this comes from another site"))


def _check(endpoint: Callable[..., object] | None, who: Principal | None, *, known: bool) -> None:
    """Roles come before bodies, paths and methods."""
    case: UseCase | None = getattr(endpoint, MARK, None)
    if case is None:
        if who is None and not (known and endpoint is not None):
            raise SignInNeeded("sign in first")
        return
    if case.roles is None:
        return
    if who is None:
        raise SignInNeeded("sign in first")
    if who.role not in case.roles:
        names = ", ".join(sorted(role.value for role in case.roles))
        raise Forbidden(f"{case.name} is for {names}; {who.name} is {who.role.value}")


def _check_body(connection: HTTPConnection, method: str, limit: int) -> None:
    length = connection.headers.get("content-length", "")
    if length.isdigit() and int(length) > limit:
        raise TooLarge(f"the body has {length} bytes; expected at most {limit}")
    has_body = length not in {"", "0"} or "transfer-encoding" in connection.headers
    if method in SAFE or not has_body:
        return
    kind = connection.headers.get("content-type", "").split(";")[0].strip().lower()
    if kind not in {"application/json", "text/csv", "image/png", "image/jpeg"}:
        raise WrongType(f"{kind[:60] or 'no type'} came; expected application/json")


def _measured(receive: Receive, limit: int) -> Receive:
    """A body that is measured while it comes."""
    size = 0

    async def next_piece() -> Message:
        nonlocal size
        message = await receive()
        size += len(message.get("body", b""))
        if size > limit:
            raise HTTPException(413, f"the body is longer than {limit} bytes")
        return message

    return next_piece


def _with_headers(send: Send, policy: str) -> Send:
    async def telling(message: Message) -> None:
        if message["type"] == "http.response.start":
            fixed = {**HEADERS, "content-security-policy": policy}
            extra = [(name.encode(), value.encode()) for name, value in fixed.items()]
            message = {**message, "headers": [*message.get("headers", []), *extra]}
        await send(message)

    return telling


async def _refuse(response: Response, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": "not from here"})
        return
    await response(scope, receive, send)
