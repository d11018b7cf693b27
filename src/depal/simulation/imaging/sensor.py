"""What a lens and a sensor add to a picture: a little blur, a little noise."""

from statistics import NormalDist

import cv2
import numpy as np
import numpy.typing as npt

Bytes = npt.NDArray[np.uint8]

BLUR = 0.6
"""The lens spreads a point over so many pixels, as a Gauss curve's width."""

PERIOD = 192
"""A picture's noise repeats after so many rows, from another one in each picture."""


def sensed(picture: Bytes, sigma: float, random: np.random.Generator) -> Bytes:
    """A picture as a sensor gives it.

    Args:
        picture: (h, w) grey or (h, w, 3) colour, sharp.
        sigma: of each value's error, drawn from 256 quantiles of a normal distribution.
        random: draws the errors.

    Returns:
        The same size.
    """
    errors = _errors(picture.shape, sigma, random)
    soft = cv2.GaussianBlur(picture, (0, 0), BLUR).astype(np.int16)
    return np.asarray(np.clip(soft + errors, 0, 255), dtype=np.uint8)


class Grain:
    """The noise of one colour sensor; each picture gets another piece of one pattern."""

    def __init__(
        self, size: tuple[int, int], sigma: float, blur: float, seed: tuple[int, ...]
    ) -> None:
        """Draws the pattern.

        Args:
            size: width and height of the pictures [pixel].
            sigma: standard deviation of a value's error.
            blur: the lens spreads a point over so many pixels.
            seed: of the run and the camera.
        """
        errors = _errors((PERIOD, size[0], 3), sigma, np.random.default_rng([*seed, 18]))
        times = -(-(size[1] + PERIOD) // PERIOD)
        self._more = np.tile(np.maximum(errors, 0).astype(np.uint8), (times, 1, 1))
        self._less = np.tile(np.maximum(-errors, 0).astype(np.uint8), (times, 1, 1))
        self._blur = blur

    def sensed(self, picture: Bytes, random: np.random.Generator) -> Bytes:
        """A picture (h, w, 3) as this sensor gives it."""
        up, down = random.integers(0, PERIOD, 2).tolist()
        height = len(picture)
        soft = cv2.GaussianBlur(picture, (5, 5), self._blur)
        brighter = cv2.add(soft, self._more[up : up + height])
        return np.asarray(cv2.subtract(brighter, self._less[down : down + height]), dtype=np.uint8)


def _errors(
    shape: tuple[int, ...], sigma: float, random: np.random.Generator
) -> npt.NDArray[np.int16]:
    normal = NormalDist(0.0, sigma)
    quantiles = np.array([normal.inv_cdf((k + 0.5) / 256) for k in range(256)])
    count = int(np.prod(shape))
    drawn = np.frombuffer(random.bytes(count), dtype=np.uint8).reshape(shape)
    return np.round(quantiles).astype(np.int16)[drawn]
