"""Whether a face bears this very print, and not an unknown sibling's: odds from what was read."""

import json
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.perception.recognition.details import reading_names
from depal.perception.recognition.tones import NAMES as TONES

Floats = npt.NDArray[np.float64]

NAMES = (
    *("cosine", "worst", "tone", "seen", "blur", "growth"),
    *("label ends", "width", "height", "top", "contrast", "windows"),
    *TONES,
    *reading_names(),
)
"""What the odds are made from."""

STEEPEST = 12.0
"""Odds are never told with more certainty than this [logarithm]."""

FARTHEST = 4.0
"""Numbers are told up to so many standard deviations from the usual ones."""


@dataclass(frozen=True, slots=True, eq=False)
class Trust:
    """Some networks with one hidden layer each, trained alike from other beginnings.

    Attributes:
        middle: (d,) mean of each number in training.
        scale: (d,) its standard deviation.
        first: (n, d + 1, k) weights of the hidden layers, the last row their offsets.
        second: (n, k + 1) weights of the outputs, the last one their offset.
        limit: odds from which on a name is believed.
    """

    middle: Floats
    scale: Floats
    first: Floats
    second: Floats
    limit: float

    def log_odds(self, numbers: Floats) -> float:
        """That a face is the print's and not a sibling's; (d,) numbers of `NAMES`."""
        inputs = np.clip((numbers - self.middle) / self.scale, -FARTHEST, FARTHEST)
        hidden = np.tanh(inputs @ self.first[:, :-1] + self.first[:, -1])
        odds = (hidden * self.second[:, :-1]).sum(axis=1) + self.second[:, -1]
        return float(np.clip(odds.mean(), -STEEPEST, STEEPEST))

    def as_text(self) -> str:
        """As it is kept in a file."""
        arrays = {
            name: np.round(getattr(self, name), 4).tolist()
            for name in ("middle", "scale", "first", "second")
        }
        return json.dumps({"names": list(NAMES), "limit": round(self.limit, 3)} | arrays) + "\n"

    @classmethod
    def from_text(cls, text: str) -> Self:
        """From a file's text.

        Raises:
            ValueError: it was trained with other numbers.
        """
        fields = json.loads(text)
        if tuple(fields["names"]) != NAMES:
            raise ValueError("the trust was trained with other numbers; train it again")
        middle, scale, first, second = (
            np.array(fields[name]) for name in ("middle", "scale", "first", "second")
        )
        return cls(middle, scale, first, second, fields["limit"])


@lru_cache(maxsize=1)
def shipped_trust() -> Trust:
    """The trust that ships."""
    folder = resources.files("depal.perception.recognition")
    return Trust.from_text(folder.joinpath("trust.json").read_text("utf-8"))
