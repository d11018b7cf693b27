"""The state of the cell as its screen shows it, from what the controller knows."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from depal.app.run.assembly import Assembly
from depal.cell.departures import Fate
from depal.cell.reporting import ChoiceNote, Line
from depal.cell.timekeeping import WAITING
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Gtin, StorageKind
from depal.geometry import OrientedBox
from depal.server.cellstate import (
    Alarm,
    CellState,
    Mode,
    QueueLine,
    RequestState,
    Solid,
    StandingBox,
    TrolleyState,
)
from depal.server.tasktrees import trees_of

SECONDS_PER_BOX = 8.0
"""How long a box takes before any has left [s]; `depal study throughput` measures it."""

MANY = 6
"""Boxes from which on a run's own pace tells how long a box takes."""


@dataclass(frozen=True, slots=True)
class Moment:
    """What a statement needs beside the controller.

    Attributes:
        mode: of the cell.
        reason: why.
        run: its number.
        began: when the run began [s].
        note: the last selection, None while there was none.
        alarms: what needs an action.
        picture: the number of the last camera picture.
    """

    mode: Mode
    reason: str
    run: int
    began: float
    note: ChoiceNote | None
    alarms: tuple[Alarm, ...]
    picture: int


def statement(wired: Assembly, moment: Moment, before: CellState) -> CellState:
    """The state now.

    Args:
        wired: the controller.
        moment: and what it does not know.
        before: the state before this one; what has not changed is taken over.
    """
    work, note = wired.work, moment.note
    fates = [departure.fate for departure in work.departures.sequence]
    settings = work.settings
    return CellState(
        version=before.version + 1,
        at=work.now,
        mode=moment.mode,
        reason=moment.reason,
        delivery=work.delivery.id,
        run=moment.run,
        boxes=sum(line.count for line in work.delivery.lines),
        stored=fates.count(Fate.STORED),
        aside=fates.count(Fate.SET_ASIDE) + fates.count(Fate.BY_PERSON),
        lost=fates.count(Fate.LOST),
        stopping=work.gate.closed,
        w=settings.w,
        speed=settings.speed,
        policy=settings.policy.value,
        joints=tuple(work.ports.arm.joints()),
        held=work.held.box if work.held is not None else None,
        target=note.target if note is not None else None,
        explanation=note.why if note is not None else "",
        rate=_rate(wired, moment, fates.count(Fate.STORED)),
        queue=_queue(work, note),
        standing=_standing(wired),
        trolleys=_trolleys(wired),
        requests=_requests(wired, moment),
        questions=before.questions,
        alarms=moment.alarms,
        trees=trees_of(wired.controller.runtime.engine.state),
        picture=moment.picture,
    )


def _rate(wired: Assembly, moment: Moment, stored: int) -> float:
    worked = wired.work.now - moment.began - wired.times.shares(wired.work.now)[WAITING]
    return 3600.0 * stored / worked if worked > 0.0 else 0.0


def _solid(shape: OrientedBox) -> Solid:
    (c, _, _), (s, _, _), _ = shape.pose.rotation
    return Solid(shape.centre, shape.size, math.atan2(s, c))


def _queue(work: Workplace, note: ChoiceNote | None) -> tuple[QueueLine, ...]:
    """What stands there now, by the scores of the last selection; what is new comes last."""
    scored = {line.box: line for line in note.lines} if note is not None else {}
    aimed = {aim.box for aim in note.aims} if note is not None else set()
    names = {gtin: product.name for gtin, product in work.delivery.products.items()}
    boxes = {box.id: box for box in work.pile.boxes}
    order = [box for box in scored if box in boxes] + [box for box in boxes if box not in scored]
    return tuple(
        _line(box, boxes[box].shape, scored.get(box), names, requested=box in aimed)
        for box in order
    )


def _line(
    box: BoxId,
    shape: OrientedBox,
    line: Line | None,
    names: Mapping[Gtin, str],
    *,
    requested: bool,
) -> QueueLine:
    if line is None:
        return QueueLine(box, None, "", _solid(shape), 0.0, 0.0, 0.0, "seen", "not selected yet")
    return QueueLine(
        box,
        line.gtin,
        names.get(line.gtin, "") if line.gtin is not None else "",
        _solid(shape),
        line.h,
        line.l,
        line.s,
        line.fate,
        line.reason,
        tuple(line.blockers),
        requested,
    )


def _standing(wired: Assembly) -> tuple[StandingBox, ...]:
    work, promises = wired.work, wired.desk.promises
    gtins = {departure.box: departure.gtin for departure in work.departures.sequence}
    return tuple(
        StandingBox(standing.id, gtins[standing.id], place, _solid(solid))
        for standing, place, solid in promises.stored()
        if standing.id in gtins
    )


def _trolleys(wired: Assembly) -> tuple[TrolleyState, ...]:
    work, books = wired.work, wired.desk.promises.books
    facts = wired.controller.runtime.engine.state.facts
    states = []
    for storage in work.layout.storages:
        maps = books.of(storage.id)
        room = sum(place_map.place.volume for place_map in maps)
        boxes = [box for place_map in maps for box in place_map.boxes]
        fixed = storage.kind is StorageKind.SHELF
        states.append(
            TrolleyState(
                storage.id,
                present=fixed or work.ports.bays.trolley(storage.id) is not None,
                boxes=len(boxes),
                fill=min(sum(box.volume for box in boxes) / room, 1.0) if room else 0.0,
                full=bool(facts.get(f"{storage.id}.full")),
                exchanging=any(asked.question.about == storage.id for asked in work.questions.open),
                aside=storage.id == work.layout.aside,
            )
        )
    return tuple(states)


def _requests(wired: Assembly, moment: Moment) -> tuple[RequestState, ...]:
    """Those that wait, with an estimate: the boxes before it at the pace of this run."""
    work, note = wired.work, moment.note
    left = work.departures.count
    worked = work.now - moment.began
    pace = worked / left if left >= MANY else SECONDS_PER_BOX
    aims = {aim.wanted: aim for aim in note.aims} if note is not None else {}
    states = []
    for wish in work.wishes:
        if wish.served is not None or wish.cancelled:
            continue
        request = wish.request
        aim = aims.get(request.wanted)
        before = None if aim is None else aim.removals
        states.append(
            RequestState(
                wish.key,
                request.gtin,
                request.box,
                request.priority,
                request.arrived,
                request.due,
                None if aim is None else aim.box,
                before,
                None if before is None else (before + 1) * pace / 60.0,
            )
        )
    return tuple(states)
