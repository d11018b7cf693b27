"""Whether the areas of a face have the colours that the picture shows.

Siblings may differ in a colour alone. Light, tape and glare change the colour of places, a
sibling that of whole areas; so areas of one colour are compared by the medians of their
differences, which little tape does not move.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.recognition.features import Features

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]

COLOURS = 6
"""A print is taken apart into so many colours at the most."""

ROUNDS = 8
"""So often the colours are moved to the middle of what is theirs."""

DISTINCT = 0.2
"""Colours differ by more than this."""

LEAST = 0.02
"""An area that covers less of a print is not compared."""

NAMES = ("median difference", "area's colour", "second area's colour", "area's brightness")
"""What is told."""


@dataclass(frozen=True, slots=True, eq=False)
class Areas:
    """A print taken apart by its colours.

    Attributes:
        label: (h, w) which colour is where; -1 where nothing is compared.
        count: how many colours there are.
    """

    label: npt.NDArray[np.int8]
    count: int


def areas_of(printed: Features) -> Areas:
    """Takes a print apart, one colour after the other that differs most from those before."""
    known = printed.weights > 0.5  # noqa: PLR2004 - half of a pixel
    label = np.full(known.shape, -1, dtype=np.int8)
    values = printed.values[known].astype(np.float64)
    if not len(values):
        return Areas(label, 0)
    colours = values.mean(axis=0, keepdims=True)
    for _ in range(COLOURS):
        away = np.square(values[:, None] - colours).sum(axis=2).min(axis=1)
        if len(colours) == COLOURS or away.max() < DISTINCT**2:
            break
        # The farthest few may be single pixels of an edge; a colour is what some share.
        far = values[away >= np.quantile(away, 1.0 - LEAST)].mean(axis=0)
        colours = np.vstack((colours, far))
        for _ in range(ROUNDS):
            own = np.square(values[:, None] - colours).sum(axis=2).argmin(axis=1)
            colours = np.array(
                [
                    values[own == k].mean(axis=0) if (own == k).any() else colour
                    for k, colour in enumerate(colours)
                ]
            )
    label[known] = np.square(values[:, None] - colours).sum(axis=2).argmin(axis=1)
    return Areas(label, len(colours))


def tones(seen: Features, printed: Features, areas: Areas) -> Floats:
    """How much the areas' colours differ, as the numbers of `NAMES`.

    Args:
        seen: features of the face, brought back to the print, as coarse as it.
        printed: features of the print.
        areas: of the print.
    """
    known = (seen.weights > 0.5) & (areas.label >= 0)  # noqa: PLR2004 - half of a pixel
    if not known.any():
        return np.ones(len(NAMES))
    away, label = (seen.values - printed.values)[known], areas.label[known]
    all_ = np.median(away, axis=0)
    usual = float(np.median(np.abs(away - all_)))
    colour, bright = [0.0, 0.0], [0.0]
    for k in range(areas.count):
        own = away[label == k]
        if len(own) >= LEAST * len(away):
            off = np.median(own, axis=0) - all_
            colour.append(float(np.hypot(off[1], off[2])))
            bright.append(abs(float(off[0])))
    first, second = sorted(colour, reverse=True)[:2]
    return np.log(np.array((usual, first, second, max(bright))) + 0.02)
