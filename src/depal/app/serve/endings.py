"""The ends of requests: told to the records once the box that serves one has found its end."""

from depal.app.serve.outside import Records
from depal.cell.departures import Departures
from depal.cell.wishes import Wishes

GONE = "its pallet is empty, and the box was not on it"


class Endings:
    """Tells each end once."""

    def __init__(self, records: Records) -> None:
        """Nothing has ended."""
        self._records = records
        self._settled: set[str] = set()

    def settle(
        self, wishes: Wishes, departures: Departures, now: float, *, over: bool = False
    ) -> None:
        """Tells what has ended since the last time.

        Args:
            wishes: of the run.
            departures: what became of its boxes.
            now: the time [s].
            over: whether the run has ended, so that nothing is served any more.

        Raises:
            DeviceError: the records cannot be written; what is not told is told the next time.
        """
        for wish in wishes:
            if not wish.key or wish.key in self._settled or wish.cancelled:
                continue
            if wish.served is not None and wish.box is not None:
                if over or departures.has_ended(wish.box):
                    reason = f"by {wish.box}"
                    self._records.request_ended(
                        wish.key, served=True, at=wish.served, reason=reason
                    )
                    self._settled.add(wish.key)
            elif over and wish.request.box is not None:
                self._records.request_ended(wish.key, served=False, at=now, reason=GONE)
                self._settled.add(wish.key)
