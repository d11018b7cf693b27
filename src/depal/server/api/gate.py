"""Before anything else is looked at: host, origin, size, and who is asking for what."""

from collections.abc import Callable, Sequence
from urllib.parse import urlsplit

from starlette.concurrency import run_in_threadpool
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.routing import BaseRoute, Match
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from depal.errors import DepalError
from depal.server.api.answers import answered, problem
from depal.server.api.contents import SAFE, check_contents, limit_of, measured
from depal.server.api.exposure import Exposure
from depal.server.problems import Forbidden, SignInNeeded
from depal.server.roles import Principal
from depal.server.site import Site
from depal.server.usecases.registry import MARK, UseCase

PREFIX = "/api/"

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
        is_api = scope["path"].startswith(PREFIX)
        if scope["type"] == "http":
            send = self._with_headers(send, API_POLICY if is_api else SCREEN_POLICY)
        refusal = self._foreign(connection, scope)
        if refusal is not None:
            await _refuse(refusal, scope, receive, send)
        elif is_api and scope["type"] == "http":
            await self._api(connection, scope, receive, send)
        else:
            await self._app(scope, receive, send)

    async def _api(
        self, connection: HTTPConnection, scope: Scope, receive: Receive, send: Send
    ) -> None:
        endpoint = self._endpoint(scope)
        try:
            who = await run_in_threadpool(self._who, connection)
            _check(endpoint, who)
            check_contents(endpoint, connection.headers, scope["method"])
        except DepalError as error:
            await answered(error)(scope, receive, send)
            return
        scope["principal"] = who
        scope["principal_now"] = lambda: self._who(connection)
        await self._app(scope, measured(receive, limit_of(endpoint)), send)

    def _endpoint(self, scope: Scope) -> Callable[..., object] | None:
        """What a request is for; None where nothing is there, or not by this method."""
        for route in self._routes:
            match, child = route.matches(scope)
            if match is Match.FULL:
                endpoint: Callable[..., object] | None = child.get("endpoint")
                return endpoint
        return None

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

    def _with_headers(self, send: Send, policy: str) -> Send:
        fixed = {**HEADERS, "content-security-policy": policy}
        if self._exposure.secure:
            fixed["strict-transport-security"] = "max-age=31536000"
        extra = [(name.encode(), value.encode()) for name, value in fixed.items()]

        async def telling(message: Message) -> None:
            if message["type"] == "http.response.start":
                message = {**message, "headers": [*message.get("headers", []), *extra]}
            await send(message)

        return telling

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
            same = _authority(origin) == host
        else:
            same = not connection.cookies.get(self._exposure.cookie)  # no browser, nothing to steal
        if same:
            return None
        return answered(Forbidden("this comes from another site"))


def _authority(origin: str) -> str:
    try:
        return urlsplit(origin).netloc
    except ValueError:
        return ""


def _check(endpoint: Callable[..., object] | None, who: Principal | None) -> None:
    """Roles come before bodies, paths and methods; what has no roles is for nobody."""
    case: UseCase | None = getattr(endpoint, MARK, None)
    if case is not None and case.roles is None:
        return
    if who is None:
        raise SignInNeeded("sign in first")
    if endpoint is None:
        return  # the app says that there is no such path, or which methods there are
    if case is None or case.roles is None:
        raise Forbidden("nobody has said who may do this")
    if who.role not in case.roles:
        names = ", ".join(sorted(role.value for role in case.roles))
        raise Forbidden(f"{case.name} is for {names}; {who.name} is {who.role.value}")


async def _refuse(response: Response, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": "not from here"})
        return
    await response(scope, receive, send)
