"""Numbers from people, checked once at the edge."""

import math

from depal.errors import SettingError


def checked_share(name: str, value: float) -> float:
    """A weight or a priority.

    Args:
        name: what it is called, for the message.
        value: any number.

    Returns:
        The value, when it is a number in [0, 1].

    Raises:
        SettingError: when it is not.
    """
    if not isinstance(value, int | float) or isinstance(value, bool) or math.isnan(value):
        raise SettingError(name, f"{value!r} is not a number", "a number in [0, 1]")
    if not 0 <= value <= 1:
        raise SettingError(name, f"{value!r} is out of range", "a number in [0, 1]")
    return float(value)
