"""Every answer that is no result, as problem+json (RFC 9457)."""

import json
import math
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.responses import Response

from depal.errors import DepalError, DeviceError
from depal.server.problems import Answer

KIND = "application/problem+json"

SHOWN = 100
"""Of a value that was given so much is told back [characters]."""


def problem(
    status: int,
    title: str,
    detail: str,
    *,
    problems: list[dict[str, str]] | None = None,
    headers: dict[str, str] | None = None,
) -> Response:
    """One problem document."""
    body: dict[str, Any] = {"type": "about:blank", "title": title, "status": status}
    body["detail"] = detail
    if problems:
        body["problems"] = problems
    text = json.dumps(body, ensure_ascii=True)
    return Response(text, status, headers=headers, media_type=KIND)


def answered(error: DepalError) -> Response:
    """What a use case says instead of a result."""
    if isinstance(error, DeviceError):
        return problem(503, "Not available now", str(error))
    if not isinstance(error, Answer):
        return problem(409, "Not possible now", str(error))
    headers = {}
    if error.status == HTTPStatus.UNAUTHORIZED:
        headers["WWW-Authenticate"] = "Bearer"
    if error.after is not None:
        headers["Retry-After"] = f"{max(1, math.ceil(error.after))}"
    problems = [
        {"where": p.where, "what": p.what, "expected": p.expected, "exists": p.exists}
        for p in error.problems
    ]
    return problem(error.status, error.title, str(error), problems=problems, headers=headers)


def install(app: FastAPI) -> None:
    """Makes every error of an app a problem document."""

    @app.exception_handler(DepalError)
    async def _depal(_: Request, error: DepalError) -> Response:
        return answered(error)

    @app.exception_handler(Exception)
    async def _fault(_: Request, error: Exception) -> Response:
        del error  # the server writes it down; who asks need not know how it is built
        return problem(500, "A fault of this server", "nothing is known about it; it was logged")

    @app.exception_handler(RequestValidationError)
    async def _invalid(_: Request, error: RequestValidationError) -> Response:
        problems = [
            {
                "where": ".".join(str(part) for part in each["loc"]),
                "what": each["msg"],
                "expected": "",
                "exists": "",
            }
            for each in error.errors()
        ]
        return problem(422, "Cannot be used", "the request cannot be used", problems=problems)

    @app.exception_handler(HTTPException)
    async def _http(_: Request, error: HTTPException) -> Response:
        title = HTTPStatus(error.status_code).phrase
        headers = dict(error.headers or {})
        return problem(error.status_code, title, str(error.detail)[:SHOWN], headers=headers)
