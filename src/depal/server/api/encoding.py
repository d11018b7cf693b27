"""Values of the use cases as JSON, with their versions as ETags."""

from collections.abc import Callable
from typing import Any

import msgspec
from fastapi import Request
from starlette.responses import Response

from depal.errors import Problem
from depal.server.problems import Unusable, VersionNeeded
from depal.server.roles import Principal
from depal.server.usecases.registry import MARK

JSON = "application/json"


def said(value: object, status: int = 200, *, version: int | None = None) -> Response:
    """A value as a response."""
    headers = {} if version is None else {"ETag": f'"{version}"'}
    body = b"" if value is None else msgspec.json.encode(value)
    return Response(body, status, headers=headers, media_type=None if value is None else JSON)


def who_asks(request: Request) -> Principal | None:
    """Who the gate has found."""
    who: Principal | None = request.scope.get("principal")
    return who


def version_in(request: Request) -> int | None:
    """The version that a change is based on; None for any.

    Raises:
        VersionNeeded: there is no If-Match.
        Unusable: it is no version.
    """
    header = request.headers.get("if-match")
    if header is None:
        raise VersionNeeded("a change needs If-Match with the ETag of what it changes, or *")
    if header.strip() == "*":
        return None
    text = header.strip().removeprefix("W/").strip('"')
    if not text.isdigit() or not text.isascii() or len(text) > 18:  # noqa: PLR2004 - fits 64 bits
        raise Unusable("no such version", [Problem("If-Match", f"{header[:40]!r}", "an ETag")])
    return int(text)


def serves(case: Callable[..., Any]) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Marks an endpoint with the use case that it serves: the gate reads its roles."""

    def marked(endpoint: Callable[..., Any]) -> Callable[..., Any]:
        setattr(endpoint, MARK, getattr(case, MARK))
        return endpoint

    return marked
