"""The weights of h as people write them."""

from depal.errors import SettingError
from depal.selection import PositionWeights


def weights_of(text: str) -> PositionWeights:
    """Three weights with commas between them, scaled to sum 1.

    Raises:
        SettingError: they are no weights.
    """
    expected = "three numbers, 0 or more and not all 0, such as 1,2,4"
    try:
        side, depth, height = (float(part) for part in text.split(","))
    except ValueError:
        raise SettingError("--weights", f"{text!r} is no list of weights", expected) from None
    total = side + depth + height
    if not (min(side, depth, height) >= 0 and 0 < total < float("inf")):
        raise SettingError("--weights", f"{text!r} is no list of weights", expected)
    return PositionWeights(side / total, depth / total, height / total)
