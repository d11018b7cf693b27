"""Whether a face bears this very print, and not an unknown sibling's: odds from what was read."""

import json
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.perception.recognition.agreement import Agreement
from depal.perception.recognition.details import reading_names

Floats = npt.NDArray[np.float64]

NAMES = ("cosine", "worst", "tone", "seen", "blurred", "more blurred", *reading_names())
"""What the odds are made from."""


def evidence(agreed: Agreement, level: int, read: Floats) -> Floats:
    """The numbers of `NAMES`.

    Args:
        agreed: how face and print agree.
        level: the blur that suits both.
        read: of the small print.
    """
    whole = [
        agreed.cosine,
        float(np.log(agreed.worst + 0.02)),
        float(np.log(agreed.worst_tone + 0.02)),
        agreed.seen,
        float(level == 1),
        float(level > 1),
    ]
    return np.concatenate((whole, read))


@dataclass(frozen=True, slots=True, eq=False)
class Trust:
    """A logistic regression.

    Attributes:
        middle: (d,) mean of each number in training.
        scale: (d,) its standard deviation.
        weights: (d,) of the scaled numbers.
        offset: of the odds.
        limit: odds from which on a name is believed.
    """

    middle: Floats
    scale: Floats
    weights: Floats
    offset: float
    limit: float

    def log_odds(self, numbers: Floats) -> float:
        """That a face is the print's and not a sibling's; (d,) numbers of `NAMES`."""
        return float((numbers - self.middle) / self.scale @ self.weights + self.offset)

    def as_text(self) -> str:
        """As it is kept in a file."""
        arrays = {
            name: np.round(getattr(self, name), 5).tolist()
            for name in ("middle", "scale", "weights")
        }
        single = {"offset": round(self.offset, 5), "limit": round(self.limit, 3)}
        return json.dumps({"names": list(NAMES)} | arrays | single, indent=1) + "\n"

    @classmethod
    def from_text(cls, text: str) -> Self:
        """From a file's text.

        Raises:
            ValueError: it was trained with other numbers.
        """
        fields = json.loads(text)
        if tuple(fields["names"]) != NAMES:
            raise ValueError("the trust was trained with other numbers; train it again")
        middle, scale, weights = (np.array(fields[name]) for name in ("middle", "scale", "weights"))
        return cls(middle, scale, weights, fields["offset"], fields["limit"])


@lru_cache(maxsize=1)
def shipped_trust() -> Trust:
    """The trust that ships."""
    folder = resources.files("depal.perception.recognition")
    return Trust.from_text(folder.joinpath("trust.json").read_text("utf-8"))
