"""What the cell says of its choices, and what it watches while the arm moves."""

import asyncio
from collections.abc import Callable

import pytest
from cells_at_work import Cell, gtin, pile

from depal.cell.departures import Departure, Departures, Fate
from depal.cell.guards import KEPT, TOUCHED, Guards
from depal.cell.questions import Questions
from depal.cell.reporting import ChoiceNote, Journalist, note_of
from depal.domain import Approach, BoxId, Gtin, PlaceId, Request
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.runtime import Context
from depal.ports import LOST, STANDS, Question
from depal.ports.fakes import FakeArm, FakeGripper, FakePerson, FakeSafety
from depal.selection import BlockingGraph, Refused, ScoreRule, select

RULE = ScoreRule(w=0.5, x_max=2.2)


def chosen(refused: tuple[str, ...] = (), *requests: Request) -> ChoiceNote:
    """A choice among three boxes in a row, of which some cannot be grasped."""
    graph = BlockingGraph(pile(3))
    grasp_for: Callable[..., str | Refused] = lambda box: (  # noqa: E731 - one line
        Refused("too far away") if box.id in refused else "a grasp"
    )
    return note_of(7.0, select(graph, requests, RULE, grasp_for))


# Choices


def test_a_choice_says_its_scores() -> None:
    """The chosen box's own, with three digits."""
    note = chosen()
    line = next(line for line in note.lines if line.box == note.target)
    assert note.why == f"best score that can be taken: s = {line.s:.3f}, h = {line.h:.3f}"
    assert note.at == 7.0


def test_a_choice_says_what_pulls_it() -> None:
    """A request raises l."""
    note = chosen((), Request(priority=0.8, gtin=gtin(2)))
    assert note.target == "b2"
    assert note.why.endswith(", pulled by a request (l = 0.80)")


def test_a_choice_says_how_many_were_passed_over() -> None:
    """Those with a better score that could not be taken."""
    best = chosen().target
    assert best is not None
    note = chosen((best,))
    assert note.target not in {None, best}
    assert note.why.endswith("; 1 with a better score are blocked or out of reach")
    line = next(line for line in note.lines if line.box == best)
    assert line.reason == "too far away"


def test_where_nothing_can_be_taken_the_outcome_says_so() -> None:
    """There is no box to give scores of."""
    note = chosen(("b1", "b2", "b3"))
    assert note.target is None
    assert note.why == note.outcome == "nothing can be grasped"
    assert [line.reason for line in note.lines] == ["too far away"] * 3


def test_all_lines_come_best_score_first() -> None:
    """As the queue of Algorithm 1."""
    scores = [line.s for line in chosen().lines]
    assert scores == sorted(scores, reverse=True)


def test_every_listener_hears_what_it_asked_for() -> None:
    """Events, choices, or both."""
    notes = Journalist()
    heard: list[int] = []
    told: list[ChoiceNote] = []
    notes.listen(heard=lambda last, _: heard.append(last))
    notes.listen(chosen=told.append)
    notes.listen(heard=lambda last, _: heard.append(-last), chosen=told.append)
    notes.heard(5, [])
    notes.chose(1.0, select(BlockingGraph(pile(1)), (), RULE, lambda _: "grasp"))
    assert heard == [5, -5]
    assert [note.target for note in told] == ["b1", "b1"]


# Guards


def guards(gripper: FakeGripper) -> Guards:
    """Over a fake arm and gripper."""
    arm = FakeArm((0.0,) * 6, gripper.load)
    return Guards(arm, gripper, FakeSafety())


def test_a_vacuum_that_breaks_is_lost_and_one_that_stands_is_not() -> None:
    """Asked again and again; other reasons come after."""
    gripper = FakeGripper({0: 1.0})
    reasons: list[str | None] = []

    async def hold() -> None:
        await gripper.suck((("front", 0), ("front", 1)))
        guard = guards(gripper).holding(lambda: other[0])
        other: list[str | None] = [None]
        reasons.append(guard())
        other[0] = "asked to stop"
        reasons.append(guard())
        await asyncio.sleep(1.0)
        reasons.append(guard())

    run_simulated(hold())
    assert reasons == [None, "asked to stop", LOST]


def test_a_hand_without_vacuum_has_lost_its_box_from_the_beginning() -> None:
    """Nothing is compared with nothing."""

    async def hold() -> str | None:
        return guards(FakeGripper()).holding()()

    assert run_simulated(hold()) == LOST


@pytest.mark.parametrize("share", [KEPT - 0.01, KEPT + 0.01])
def test_a_module_may_leak_a_little(share: float) -> None:
    """Half of its vacuum is the limit, for each module by itself."""

    class Leaking(FakeGripper):
        left = 1.0

        def vacuum(self) -> dict[str, float]:
            return {"front": 30_000.0, "lower": 30_000.0 * self.left}

    gripper = Leaking()
    guard = guards(gripper).holding()
    gripper.left = share
    assert guard() == (LOST if share < KEPT else None)


@pytest.mark.parametrize("share", [TOUCHED - 0.01, TOUCHED + 0.01])
def test_a_box_stands_when_less_than_its_weight_hangs_on_the_arm(share: float) -> None:
    """And then the descent ends."""
    arm, gripper = FakeArm((0.0,) * 6, lambda: 5.0 * share), FakeGripper()

    async def lower() -> str | None:
        await gripper.suck((("front", 0),))
        return Guards(arm, gripper, FakeSafety()).setting_down(5.0)()

    assert run_simulated(lower()) == (STANDS if share < TOUCHED else None)


def test_a_motion_is_asked_to_stop_by_the_executive() -> None:
    """Its reason is handed on."""
    action = Cell(1).works().work.runtime.engine.repository.schemata["look"]
    context = Context(1, action, {}, {})  # type: ignore[arg-type]
    guard = guards(FakeGripper()).asked_to_stop(context)
    assert guard() is None
    context.stop_reason = "withdrawn"
    assert guard() == "withdrawn"


# Questions and departures


def test_a_question_is_open_until_it_is_answered() -> None:
    """With the times of both."""
    person = FakePerson(delay=5.0)
    questions = Questions(person, LoopClock())
    question = Question("q", "Well?", ("yes", "no"), "b1")
    seen: list[int] = []

    async def ask() -> str:
        asking = asyncio.ensure_future(questions.ask(question))
        await asyncio.sleep(1.0)
        seen.append(len(questions.open))
        return await asking

    assert run_simulated(ask()) == "yes"
    assert seen == [1]
    assert questions.open == ()
    (asked,) = questions.all
    assert (asked.asked, asked.answered, asked.answer) == (0.0, 5.0, "yes")


def test_the_first_word_on_a_box_counts() -> None:
    """A lost box is not stored afterwards."""
    departures = Departures()
    departures.leaves(BoxId("b1"), 3.0)
    for fate, place in ((Fate.LOST, None), (Fate.STORED, PlaceId("here"))):
        departures.ends(Departure(BoxId("b1"), Gtin("g"), Approach.VERTICAL, place, fate, "", 9.0))
    (only,) = departures.sequence
    assert (only.fate, only.place, only.at) == (Fate.LOST, None, 3.0)
    assert departures.count == 1
