"""Days and hours as people read them, in the time zone of the cell's computer."""

from datetime import UTC, datetime


def day_of(at: float) -> str:
    """A day.

    Args:
        at: seconds since 1970.
    """
    return f"{datetime.fromtimestamp(at, UTC).astimezone():%Y-%m-%d}"


def moment_of(at: float) -> str:
    """A day and a time.

    Args:
        at: seconds since 1970.
    """
    return f"{datetime.fromtimestamp(at, UTC).astimezone():%Y-%m-%d %H:%M}"


def minutes_of(seconds: float) -> str:
    """Minutes and seconds of a run.

    Args:
        seconds: since it began [s].
    """
    whole = int(seconds)
    return f"{whole // 60:d}:{whole % 60:02d}"
