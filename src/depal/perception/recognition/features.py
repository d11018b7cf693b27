"""What of a picture resists the light."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

Narrow = npt.NDArray[np.float32]

DARKEST = 0.1
"""Added to values whose mean is one before their logarithm: dark pixels are mostly noise."""

BLACK = 0.002
"""Pixels that are darker in all colours were not photographed; their features are zero."""

WIDE = 0.03
"""Brightness is compared with that around, averaged with a Gauss curve of this width [m]."""

SHARP = 0.004
"""Strokes of small letters are about as wide [m]."""

AROUND = 0.05
"""The same for colours, where they are compared with those around [m]."""

EMPTY = cv2.BORDER_CONSTANT

THIN = 4
"""The average around changes slowly: it is taken over pixels so many times larger."""


@dataclass(frozen=True, slots=True, eq=False)
class Features:
    """Features of a picture's pixels.

    Attributes:
        values: (h, w, 3) float32: log of brightness over that around it, log of red over green,
            log of blue over green; each with a mean of zero.
        weights: (h, w) float32: 0 where nothing is known, else up to 1.
        step: edge of a pixel [m].
    """

    values: Narrow
    weights: Narrow
    step: float

    def turned(self, quarter: int) -> "Features":
        """Turned clockwise by so many quarters."""
        if quarter % 4 == 0:
            return self
        values, weights = np.rot90(self.values, -quarter), np.rot90(self.weights, -quarter)
        return Features(np.ascontiguousarray(values), np.ascontiguousarray(weights), self.step)

    def thinned(self, every: int) -> "Features":
        """Means over squares of so many pixels, known ones alone."""
        weights = shrunk(self.weights, every)
        values = shrunk(self.values * self.weights[..., None], every)
        values /= np.maximum(weights, np.float32(1e-3))[..., None]
        return Features(values, weights, self.step * every)

    def sharpened(self, around: float = SHARP) -> "Features":
        """Every feature less its mean around: strokes and edges stay, areas go.

        Args:
            around: the Gauss curve's width of the mean [m].
        """
        soft = cv2.GaussianBlur(self.values, (0, 0), around / self.step)
        return Features(self.values - np.asarray(soft), self.weights, self.step)

    def flattened(self) -> "Features":
        """Every feature compared with that around it."""
        values = self.values * self.weights[..., None]
        sums = cv2.GaussianBlur(values, (0, 0), AROUND / self.step, borderType=EMPTY)
        count = cv2.GaussianBlur(self.weights, (0, 0), AROUND / self.step, borderType=EMPTY)
        flat = values - sums / np.maximum(count, np.float32(1e-3))[..., None]
        flat *= (self.weights > 0)[..., None]
        return Features(np.asarray(flat, dtype=np.float32), self.weights, self.step)


def features_of(
    colour: npt.NDArray[np.uint8] | Narrow,
    weights: Narrow,
    step: float,
    counts: Narrow | None = None,
) -> Features:
    """The features of a picture.

    Gains of the channels cancel exactly, a slow gradient of the light nearly.

    Args:
        colour: (h, w, 3) RGB, any scale.
        weights: (h, w): 0 where nothing is known.
        step: edge of a pixel [m].
        counts: (h, w) weights for means, where these are not of all that is known.
    """
    mean_weights = weights if counts is None else counts
    total = max(float(mean_weights.sum()), 1e-6)
    values = colour.astype(np.float32)
    means = np.einsum("ijk,ij->k", values, mean_weights) / np.float32(total)
    values /= np.maximum(means, np.float32(1e-6))
    red, green, blue = cv2.split(cv2.log(values + np.float32(DARKEST)))
    bright = np.asarray((red + green + blue) / np.float32(3.0), dtype=np.float32)
    bright -= _around(bright, mean_weights, WIDE / step)
    channels = (bright, red - green, blue - green)
    features = np.asarray(cv2.merge(channels), dtype=np.float32)
    offsets = np.einsum("ijk,ij->k", features, mean_weights) / np.float32(total)
    features -= offsets
    brightest = cv2.max(cv2.max(values[..., 0], values[..., 1]), values[..., 2])
    features[np.asarray(brightest) <= BLACK] = 0.0
    return Features(features, weights, step)


def shrunk(values: Narrow, every: int) -> Narrow:
    """Means over squares of so many pixels; what is left over at the far edges is cut off."""
    height, width = (max(edge // every, 1) for edge in values.shape[:2])
    cut = values[: height * every, : width * every]
    return np.asarray(cv2.resize(cut, (width, height), interpolation=cv2.INTER_AREA))


def _around(values: Narrow, weights: Narrow, sigma: float) -> Narrow:
    """The weighted mean around each pixel."""
    height, width = values.shape
    size = (max(width // THIN, 1), max(height // THIN, 1))
    pair = cv2.merge((values * weights, weights))
    small = cv2.resize(pair, size, interpolation=cv2.INTER_AREA)
    soft = cv2.GaussianBlur(small, (0, 0), sigma / THIN, borderType=EMPTY)
    mean = soft[..., 0] / np.maximum(soft[..., 1], np.float32(1e-4))
    return np.asarray(cv2.resize(mean, (width, height), interpolation=cv2.INTER_LINEAR))
