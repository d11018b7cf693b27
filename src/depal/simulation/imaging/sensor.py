"""What a lens and a sensor add to a picture: a little blur, a little noise."""

from statistics import NormalDist

import cv2
import numpy as np
import numpy.typing as npt

Bytes = npt.NDArray[np.uint8]

BLUR = 0.6
"""The lens spreads a point over so many pixels, as a Gauss curve's width."""


def sensed(picture: Bytes, sigma: float, random: np.random.Generator) -> Bytes:
    """A picture as a sensor gives it.

    Args:
        picture: (h, w) grey or (h, w, 3) colour, sharp.
        sigma: of each value's error, drawn from 256 quantiles of a normal distribution.
        random: draws the errors.

    Returns:
        The same size.
    """
    normal = NormalDist(0.0, sigma)
    quantiles = np.array([normal.inv_cdf((k + 0.5) / 256) for k in range(256)])
    drawn = np.frombuffer(random.bytes(picture.size), dtype=np.uint8).reshape(picture.shape)
    errors = np.round(quantiles).astype(np.int16)[drawn]
    soft = cv2.GaussianBlur(picture, (0, 0), BLUR).astype(np.int16)
    return np.asarray(np.clip(soft + errors, 0, 255), dtype=np.uint8)
