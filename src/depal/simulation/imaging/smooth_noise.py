"""Random fields whose neighbours are alike."""

import numpy as np
import numpy.typing as npt
import scipy.fft


def smooth_noise(
    shape: tuple[int, int], widths: tuple[float, float], random: np.random.Generator
) -> npt.NDArray[np.float32]:
    """White noise under a Gauss curve; it repeats beyond its edges.

    Args:
        shape: rows and columns.
        widths: standard deviations of the curve along columns and rows [pixel].
        random: draws it.

    Returns:
        Of this shape, mean 0 and variance 1.
    """
    rows, columns = shape
    spectrum = scipy.fft.rfft2(random.standard_normal(shape, dtype=np.float32))
    down = np.exp(-2 * (np.pi * widths[0] * scipy.fft.fftfreq(rows)) ** 2)
    across = np.exp(-2 * (np.pi * widths[1] * scipy.fft.rfftfreq(columns)) ** 2)
    spectrum *= np.outer(down, across).astype(np.float32)
    field = scipy.fft.irfft2(spectrum, shape)
    return np.asarray((field - field.mean()) / max(float(field.std()), 1e-9), dtype=np.float32)
