"""What comes and goes over the API: kinds of content, and how large a body may be."""

from collections.abc import Callable
from typing import Any

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import Message, Receive

from depal.server.problems import NotAcceptable, TooLarge, WrongType

SAFE = frozenset({"GET", "HEAD", "OPTIONS"})

JSON = "application/json"

USUAL, LARGE = 64 * 1024, 5 * 2**20 + 4096
"""Of a body [byte]: usually, and where files are uploaded."""

TAKEN, GIVEN = "taken_kinds", "given_kinds"

Endpoint = Callable[..., Any]


def uploads(*kinds: str) -> Callable[[Endpoint], Endpoint]:
    """Marks an endpoint that takes files of some kinds."""

    def marked(endpoint: Endpoint) -> Endpoint:
        setattr(endpoint, TAKEN, kinds)
        return endpoint

    return marked


def gives(*kinds: str) -> Callable[[Endpoint], Endpoint]:
    """Marks an endpoint whose results are no JSON."""

    def marked(endpoint: Endpoint) -> Endpoint:
        setattr(endpoint, GIVEN, kinds)
        return endpoint

    return marked


def limit_of(endpoint: Endpoint | None) -> int:
    """How large a body may be [byte]."""
    return LARGE if hasattr(endpoint, TAKEN) else USUAL


def check_contents(endpoint: Endpoint | None, headers: Headers, method: str) -> None:
    """By what the headers say.

    Raises:
        NotAcceptable: the client takes nothing that there is.
        TooLarge: the body.
        WrongType: the body is of another kind.
    """
    given = getattr(endpoint, GIVEN, (JSON,))
    if endpoint is not None and not accepts(headers.get("accept", ""), given):
        raise NotAcceptable(f"there is {', '.join(given)}; it is not in Accept")
    length, limit = headers.get("content-length", ""), limit_of(endpoint)
    if length.isdecimal() and int(length) > limit:
        raise TooLarge(f"the body has {length} bytes; expected at most {limit}")
    has_body = length not in {"", "0"} or "transfer-encoding" in headers
    taken = getattr(endpoint, TAKEN, (JSON,))
    kind = _kind(headers.get("content-type", ""))
    if method not in SAFE and has_body and kind not in taken:
        raise WrongType(f"{kind[:60] or 'no type'} came; expected {' or '.join(taken)}")


def accepts(header: str, kinds: tuple[str, ...]) -> bool:
    """Whether an Accept header allows one of some kinds (RFC 9110, 12.5.1)."""
    ranges = [part for part in header.split(",") if part.strip()]
    allowed = {_kind(part) for part in ranges if _weight(part) > 0.0}
    wanted = {each for kind in kinds for each in (kind, f"{kind.split('/')[0]}/*", "*/*")}
    return not ranges or bool(allowed & wanted)


def _kind(text: str) -> str:
    return text.split(";", maxsplit=1)[0].strip().lower()


def _weight(media_range: str) -> float:
    for parameter in media_range.split(";")[1:]:
        name, _, value = parameter.partition("=")
        if name.strip().lower() == "q":
            try:
                return float(value)
            except ValueError:
                return 0.0
    return 1.0


def measured(receive: Receive, limit: int) -> Receive:
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
