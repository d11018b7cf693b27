"""One look at what was given."""

import time

from depal.app.reports.report import Report
from depal.app.see.given import Given
from depal.app.see.report import see_report
from depal.studies.perception.eye import open_eye


def look_at(seen: Given) -> Report:
    """Looks, and says what was found."""
    eye = open_eye(seen.region, seen.note, seen.book, seen.sizes)
    begun = time.perf_counter()
    look = eye.look(seen.frames)
    return see_report(seen, look, time.perf_counter() - begun)
