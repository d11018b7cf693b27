"""Working with the cell: see it, start, hold, stop, and ask why."""

from dataclasses import dataclass

from depal.domain import Delivery
from depal.errors import DepalError, Problem
from depal.server.cell import Order, Settings
from depal.server.cellstate import CellState, Mode, TaskTree
from depal.server.events import Event
from depal.server.problems import Conflict, NotFound, Stale, Unusable
from depal.server.records import Kept
from depal.server.records.runs import FAILED
from depal.server.roles import ALL, PEOPLE, SET_UP, WORKERS, Principal
from depal.server.site import Site
from depal.server.usecases.registry import use_case

POLICIES = ("paper", "access")

SLOWEST = 0.05
"""The least share of the arm's full speed."""

MOST = 500
"""So many events are told at once at the most."""


@dataclass(frozen=True, slots=True)
class Plan:
    """A setting with its bounds, for whoever offers it.

    Attributes:
        name: of the setting.
        least: its smallest value.
        most: its greatest value.
        choices: where it is one of several words.
    """

    name: str
    least: float | None = None
    most: float | None = None
    choices: tuple[str, ...] = ()


BOUNDS = (Plan("w", 0.0, 1.0), Plan("speed", SLOWEST, 1.0), Plan("policy", choices=POLICIES))


@use_case(PEOPLE)
def see_state(site: Site, who: Principal | None) -> CellState:
    """The state of the cell now."""
    del who
    return site.cell.state()


@use_case(PEOPLE)
def see_trees(site: Site, who: Principal | None) -> tuple[TaskTree, ...]:
    """The executive's task trees now."""
    del who
    return site.cell.state().trees


@use_case(PEOPLE)
def ask_why(site: Site, who: Principal | None, box: str) -> str:
    """Why the last selection took a box, or did not."""
    del who
    known = [line.box for line in site.cell.state().queue]
    if box not in known:
        raise NotFound(f"box {box!r} does not stand on the pallet as far as the cell knows")
    return site.cell.why(box)


@use_case(PEOPLE)
def see_picture(site: Site, who: Principal | None) -> bytes:
    """The last camera picture with what was seen in it, as JPEG."""
    del who
    picture = site.cell.picture()
    if not picture:
        raise NotFound("no camera has looked yet")
    return picture


@use_case(ALL)
def read_events(
    site: Site, who: Principal | None, after: int = 0, limit: int = 100
) -> tuple[Event, ...]:
    """The events of the journal after a number."""
    del who
    return site.events.after(max(after, 0), max(1, min(limit, MOST)))


@use_case(ALL)
def last_event(site: Site, who: Principal | None) -> int:
    """The number of the newest event."""
    del who
    return site.events.last


@use_case(WORKERS, command=True)
def start(site: Site, who: Principal | None, delivery: str | None = None) -> CellState:
    """Start a delivery of the queue, or go on after a stop, a hold or a restart."""
    state = site.cell.state()
    standing = state.run is not None and state.mode not in {Mode.COMPLETE, Mode.IDLE}
    if standing:
        if delivery is not None and delivery != state.delivery:
            raise Conflict(f"delivery {state.delivery} is not finished yet")
        site.cell.start(None)
        return site.cell.state()
    name = delivery or site.queue.next()
    if name is None:
        raise Conflict("no delivery waits; add one to the queue")
    _begin(site, who, site.queue.get(name)[1])
    return site.cell.state()


def _begin(site: Site, who: Principal | None, found: Delivery) -> None:
    """A run is written down before anything moves; what cannot be begun waits again.

    Of two people who press Start at once one begins the run, and the other is told so.
    """
    number = site.runs.begin(found.id, _name(who))
    try:
        requests = site.requests.waiting(number, site.cell.state().at)
        site.cell.start(Order(number, found, requests))
    except DepalError as error:
        site.runs.end(number, FAILED, {"reason": str(error)})
        raise
    known = {key for key, _ in requests}
    for key, request in site.requests.waiting(number, site.cell.state().at):
        if key not in known:  # it came while the cell began
            site.cell.add_request(key, request)


@use_case(WORKERS, command=True)
def hold(site: Site, who: Principal | None) -> CellState:
    """Nothing new begins; the arm finishes what it does."""
    site.cell.hold(_name(who))
    return site.cell.state()


@use_case(WORKERS, command=True)
def resume(site: Site, who: Principal | None) -> CellState:
    """Go on after a hold."""
    site.cell.resume(_name(who))
    return site.cell.state()


@use_case(WORKERS, command=True)
def stop_after_box(site: Site, who: Principal | None) -> CellState:
    """Finish the box in hand, then stop."""
    site.cell.stop_after_box(_name(who))
    return site.cell.state()


@use_case(PEOPLE)
def see_settings(site: Site, who: Principal | None) -> Kept:
    """The settings of the cell."""
    del who
    return site.settings.get()


@use_case(SET_UP, command=True)
def change_settings(
    site: Site,
    who: Principal | None,
    *,
    w: float,
    speed: float,
    policy: str,
    version: int | None = None,
) -> Kept:
    """Change the settings of the cell, each within its bounds."""
    del who
    problems = []
    if not 0.0 <= w <= 1.0:
        problems.append(Problem("w", f"{w!r} is out of range", "a number in [0, 1]"))
    if not SLOWEST <= speed <= 1.0:
        expected = f"a number in [{SLOWEST}, 1]"
        problems.append(Problem("speed", f"{speed!r} is out of range", expected))
    if policy not in POLICIES:
        problems.append(Problem("policy", f"{policy[:20]!r}", ", ".join(POLICIES)))
    if problems:
        raise Unusable("these settings cannot be used", problems)
    settings = Settings(w, speed, policy)
    known = site.settings.get()
    if version is not None and version != known.version:
        raise Stale(f"the settings have version {known.version} now")
    site.cell.set(settings)
    return site.settings.put(settings, version)


def _name(who: Principal | None) -> str:
    return "nobody" if who is None else who.name
