"""A network with one hidden layer, trained by gradients of its cross-entropy."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.scoring import FaceScore

Floats = npt.NDArray[np.float64]

NARROWEST = 1e-2
"""A feature that hardly varies is scaled by this."""


@dataclass(frozen=True, slots=True)
class Schooling:
    """How a network is trained.

    Attributes:
        hidden: units of the hidden layer.
        steps: so many batches.
        batch: examples in one.
        rate: of the first steps.
        decay: pull of every weight towards zero.
    """

    hidden: int = 24
    steps: int = 6000
    batch: int = 4096
    rate: float = 3e-3
    decay: float = 1e-4


def trained(
    features: Floats, faces: Floats, random: np.random.Generator, schooling: Schooling | None = None
) -> FaceScore:
    """A score that tells faces from other rectangles.

    Args:
        features: (n, d) as `depal.perception.scoring` describes rectangles.
        faces: (n,) 1 where a rectangle is a face, else 0.
        random: draws the first weights and the batches.
        schooling: how to train.
    """
    how = schooling or Schooling()
    middle, scale = features.mean(axis=0), np.maximum(features.std(axis=0), NARROWEST)
    inputs = np.column_stack(((features - middle) / scale, np.ones(len(features))))
    width = inputs.shape[1]
    weights = [
        random.normal(0.0, width**-0.5, (width, how.hidden)),
        random.normal(0.0, 0.3, how.hidden + 1),
    ]
    means = [np.zeros_like(each) for each in weights]
    squares = [np.zeros_like(each) for each in weights]
    for step in range(1, how.steps + 1):
        rows = random.integers(0, len(inputs), how.batch)
        slopes = _slopes(weights, inputs[rows], faces[rows])
        rate = how.rate * min(1.0, 3.0 * (1.0 - step / how.steps) + 0.02)
        for k, slope in enumerate(slopes):
            pulled = slope + how.decay * weights[k]
            means[k] += 0.1 * (pulled - means[k])
            squares[k] += 0.001 * (pulled * pulled - squares[k])
            move = means[k] / (1.0 - 0.9**step)
            weights[k] -= rate * move / (np.sqrt(squares[k] / (1.0 - 0.999**step)) + 1e-8)
    return FaceScore(middle, scale, weights[0], weights[1])


def _slopes(weights: list[Floats], inputs: Floats, faces: Floats) -> tuple[Floats, Floats]:
    """Gradients of the mean cross-entropy of a batch."""
    first, second = weights
    hidden = np.tanh(inputs @ first)
    ones = np.ones((len(hidden), 1))
    odds = np.hstack((hidden, ones)) @ second
    error = (1.0 / (1.0 + np.exp(-odds)) - faces) / len(faces)
    back = np.outer(error, second[:-1]) * (1.0 - hidden * hidden)
    return inputs.T @ back, np.hstack((hidden, ones)).T @ error
