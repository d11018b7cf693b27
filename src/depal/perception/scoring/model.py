"""The score: a small network that was trained on simulated scenes, as numbers in a file."""

import json
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.perception.faces import Facing
from depal.perception.scoring.features import NAMES

Floats = npt.NDArray[np.float64]

STEEPEST = 20.0
"""Odds are never told with more certainty than this [logarithm]."""


@dataclass(frozen=True, slots=True, eq=False)
class FaceScore:
    """From features to the logarithm of odds.

    Attributes:
        middle: (d,) mean of each feature in training.
        scale: (d,) its standard deviation.
        first: (d + 1, k) weights of the hidden layer, the last row its offsets.
        second: (k + 1,) weights of the output, the last one its offset.
    """

    middle: Floats
    scale: Floats
    first: Floats
    second: Floats

    def log_odds(self, features: Floats) -> Floats:
        """(n,) of being a face, of features (n, d)."""
        if not len(features):
            return np.zeros(0)
        inputs = (features - self.middle) / self.scale
        hidden = np.tanh(inputs @ self.first[:-1] + self.first[-1])
        odds = hidden @ self.second[:-1] + self.second[-1]
        return np.asarray(np.clip(odds, -STEEPEST, STEEPEST))

    def as_text(self) -> str:
        """As it is kept in a file."""
        fields = {"features": list(NAMES)}
        arrays = {
            name: np.round(getattr(self, name), 5).tolist()
            for name in ("middle", "scale", "first", "second")
        }
        return json.dumps(fields | arrays, indent=1) + "\n"

    @classmethod
    def from_text(cls, text: str) -> Self:
        """From a file's text.

        Raises:
            ValueError: it was trained with other features.
        """
        fields = json.loads(text)
        if tuple(fields["features"]) != NAMES:
            raise ValueError("the score was trained with other features; train it again")
        return cls(*(np.array(fields[name]) for name in ("middle", "scale", "first", "second")))


@lru_cache(maxsize=2)
def shipped_score(facing: Facing = Facing.FRONT) -> FaceScore:
    """The score that ships for faces that look this way.

    Tops have one of their own: they are seen from nearer by, and boxes on them hide parts.
    """
    name = "tops.json" if facing is Facing.TOP else "faces.json"
    text = resources.files("depal.perception.scoring").joinpath(name).read_text("utf-8")
    return FaceScore.from_text(text)
