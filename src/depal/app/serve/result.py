"""What came of a run, for whoever looks at it later."""

from depal.app.run.assembly import Assembly
from depal.cell.departures import Fate
from depal.cell.timekeeping import WAITING
from depal.cell.wishes import Wish


def result_of(wired: Assembly, began: float) -> dict[str, object]:
    """The result of a run that began at a time [s of the cell's clock]."""
    work = wired.work
    fates = [departure.fate for departure in work.departures.sequence]
    waiting = wired.times.shares(work.now)[WAITING]
    return {
        "delivery": work.delivery.id,
        "boxes": sum(line.count for line in work.delivery.lines),
        "stored": fates.count(Fate.STORED),
        "lost": fates.count(Fate.LOST),
        "exceptions": [
            {"box": d.box, "reason": d.reason, "outcome": d.fate.value, "gtin": d.gtin}
            for d in work.departures.sequence
            if d.fate in {Fate.SET_ASIDE, Fate.BY_PERSON}
        ],
        "sequence": [
            {
                "box": d.box,
                "gtin": d.gtin,
                "place": d.place,
                "outcome": d.fate.value,
                "at": d.at,
            }
            for d in work.departures.sequence
        ],
        "requests": [_told_of(wish) for wish in work.wishes],
        "questions": [
            {"text": asked.question.text, "answer": asked.answer} for asked in work.questions.all
        ],
        "seconds": work.now - began,
        "waiting_seconds": waiting,
    }


def _told_of(wish: Wish) -> dict[str, object]:
    request = wish.request
    return {
        "key": wish.key,
        "gtin": request.gtin,
        "box": request.box,
        "priority": request.priority,
        "arrived": request.arrived,
        "served": wish.served,
        "by": wish.box,
        "boxes_before": wish.boxes_before,
        "cancelled": wish.cancelled,
    }
