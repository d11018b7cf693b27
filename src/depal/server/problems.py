"""Why the store's side cannot do what was asked for, in the terms of HTTP.

DepalError
└── Answer              what was asked for is answered with a reason
├── SignInNeeded    401
├── Forbidden       403
├── NotFound        404
├── NotAcceptable   406
├── Conflict        409
├── Stale           412
├── TooLarge        413
├── WrongType       415
├── Unusable        422
├── VersionNeeded   428
└── TooMany         429
"""

from collections.abc import Sequence
from typing import ClassVar

from depal.errors import DepalError, Problem


class Answer(DepalError):  # noqa: N818 - it is an answer, and no fault
    """What was asked for is answered with a reason.

    Attributes:
        status: of HTTP.
        title: the same for every answer of this kind.
        problems: everything that is wrong with what was given.
        after: when to try again [s], where that is known.
    """

    status: ClassVar[int] = 400
    title: ClassVar[str] = "Not possible"

    def __init__(
        self, message: str, problems: Sequence[Problem] = (), after: float | None = None
    ) -> None:
        """Says why."""
        super().__init__(message)
        self.problems, self.after = tuple(problems), after


class SignInNeeded(Answer):
    """Nobody is signed in, or no longer."""

    status, title = 401, "Sign in first"


class Forbidden(Answer):
    """The role may not do this."""

    status, title = 403, "Not allowed"


class NotFound(Answer):
    """There is no such thing."""

    status, title = 404, "Not found"


class NotAcceptable(Answer):
    """It exists, but not as one of the kinds that were asked for."""

    status, title = 406, "Not in these kinds"


class Conflict(Answer):
    """It cannot be done in this state."""

    status, title = 409, "Not possible now"


class Stale(Answer):
    """Somebody else has changed it meanwhile."""

    status, title = 412, "Changed meanwhile"


class TooLarge(Answer):
    """More than is taken."""

    status, title = 413, "Too large"


class WrongType(Answer):
    """Another kind of content was expected."""

    status, title = 415, "Wrong type"


class Unusable(Answer):
    """What was given cannot be used."""

    status, title = 422, "Cannot be used"


class VersionNeeded(Answer):
    """A change must say which version it changes."""

    status, title = 428, "Version needed"


class TooMany(Answer):
    """Too many tries; later again."""

    status, title = 429, "Too many tries"
