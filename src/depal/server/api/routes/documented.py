"""What every operation says about itself in the OpenAPI document."""

from typing import Any

from pydantic import BaseModel


class ProblemLine(BaseModel):
    """One thing that is wrong."""

    where: str
    what: str
    expected: str
    exists: str


class ProblemDocument(BaseModel):
    """RFC 9457."""

    type: str
    title: str
    status: int
    detail: str
    problems: list[ProblemLine] = []


MEANINGS = {
    400: "The request cannot be read",
    401: "Nobody is signed in, or no longer",
    403: "The role may not do this",
    404: "There is no such thing",
    405: "This path knows other methods",
    406: "The client takes nothing that there is",
    409: "It cannot be done in this state",
    412: "Somebody else has changed it meanwhile",
    413: "Too large",
    415: "Another type was expected",
    421: "The cell is not reached by this name",
    422: "What was given cannot be used",
    428: "A change needs If-Match",
    429: "Too many tries",
    503: "A device or the database does not answer",
}


def answers(*more: int) -> dict[int | str, dict[str, Any]]:
    """The problem documents that an operation may answer with."""
    usual = {400, 401, 403, 405, 406, 409, 413, 415, 421, 422, 503}
    content: dict[str, Any] = {"application/problem+json": {}}
    return {
        status: {
            "model": ProblemDocument,
            "description": MEANINGS[status],
            "content": content,
        }
        for status in sorted(usual | set(more))
    }


def leads(status: int, value: str, **to: str) -> dict[int | str, dict[str, Any]]:
    """What a client can do next with what it has got: links of the OpenAPI document.

    Args:
        status: of the answer that has it.
        value: where it is in the answer's body, as a JSON pointer.
        to: for each operation the parameter that takes it.
    """
    links = {
        operation: {
            "operationId": operation,
            "parameters": {
                f"path.{parameter}": f"$response.body#{value}",
                **({"header.if-match": "*"} if operation in CHANGES else {}),
            },
        }
        for operation, parameter in to.items()
    }
    return {status: {"links": links}}


CHANGES = {
    "assign_product",
    "cancel_delivery",
    "cancel_request",
    "change_person",
    "change_request",
    "move_delivery",
    "put_product",
    "remove_person",
}
"""Operations that need If-Match."""
