"""What the storm in light worlds has shown."""

from collections import Counter
from collections.abc import Sequence

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.light.referee import Count
from depal.app.light.run import LightOutcome, summed
from depal.app.light.storm import Storm, Stormed, wrongs_of
from depal.app.reports.report import Report, plain_table, verdict
from depal.studies.statistics import Share

SHOWN = 12
"""So many breaches are shown; the file has all."""


def storm_report(done: Stormed, asked: Storm, seconds: float) -> Report:
    """The report; it holds when nothing is lost, doubled or misplaced but in the control."""
    cuts: dict[str, Json] = {}
    fields: dict[str, Json] = {"storm": {"seed": asked.seed, "seconds": seconds}, "cuts": cuts}
    shown: list[RenderableType] = []
    holds = True
    heads = ("what", "runs", "cuts", "boxes", "stored", "lost", "doubled", "misplaced", "")
    table = plain_table("Light worlds", *heads)
    kinds = (
        ("cuts at every write", "positions", done.positions),
        ("cuts at random moments", "random", done.random),
        ("the control", "control", done.control),
        ("long shift", "shift", done.shift),
    )
    for what, name, outcomes in kinds:
        if not outcomes:
            continue
        count, wrongs = summed(outcomes), wrongs_of(outcomes)
        good = bool(_bad(count)) if name == "control" else not (_bad(count) or wrongs)
        holds = holds and good
        table.row(
            what,
            str(len(outcomes)),
            str(sum(each.cuts for each in outcomes)),
            str(count.boxes),
            str(count.stored),
            str(count.lost),
            str(count.doubled),
            str(count.misplaced),
            verdict(good, "met", "missed"),
        )
        (fields if name == "shift" else cuts)[name] = _fields(outcomes, count, wrongs)
        if name != "control":
            shown += [Text(line, style="red") for line in wrongs[:SHOWN]]
    if done.shift:
        shown.append(Text(_interventions(done.shift)))
    return Report(fields, [table, *shown], holds=holds)


def _bad(count: Count) -> int:
    return count.lost + count.doubled + count.misplaced


def _asked(outcomes: Sequence[LightOutcome]) -> Share:
    return Share(sum(len(each.asked) for each in outcomes), summed(outcomes).boxes)


def _interventions(outcomes: Sequence[LightOutcome]) -> str:
    share = _asked(outcomes)
    low, high = share.ci95
    return (
        f"a person was asked {1000 * share.value:.2f} times in 1,000 boxes "
        f"(95 %: {1000 * low:.2f} to {1000 * high:.2f}), exchanges of trolleys left out"
    )


def _fields(
    outcomes: Sequence[LightOutcome], count: Count, wrongs: Sequence[str]
) -> dict[str, Json]:
    share, struck, found = _asked(outcomes), Counter[str](), Counter[str]()
    for outcome in outcomes:
        struck.update(outcome.struck)
        found.update(outcome.found)
    return {
        "runs": len(outcomes),
        "cuts": sum(each.cuts for each in outcomes),
        "boxes": count.boxes,
        "stored": count.stored,
        "aside": count.aside,
        "by_person": count.by_person,
        "dropped": count.dropped,
        "left": count.left,
        "lost": count.lost,
        "doubled": count.doubled,
        "misplaced": count.misplaced,
        "struck": dict(sorted(struck.items())),
        "restarts_found": dict(sorted(found.items())),
        "interventions_per_1000": {
            "value": 1000 * share.value,
            "ci95": [1000 * edge for edge in share.ci95],
        },
        "exchanges": sum(each.exchanges for each in outcomes),
        "sim_seconds": sum(each.sim_seconds for each in outcomes),
        "wrong": list(wrongs),
    }
