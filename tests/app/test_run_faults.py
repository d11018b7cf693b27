"""Faults that strike whole runs in physics: each ends as its catalogue entry says."""

import math

import pytest
from tiny_runs import THREE, run

from depal.app.faults.verdicts import broken_in, verdict_of
from depal.app.run.summary import Outcome
from depal.cell.departures import Fate
from depal.cell.planning.clearing import Clearing
from depal.domain import PlaceId
from depal.simulation.faults import CATALOGUE, Fault, FaultPlan, Phase, When
from depal.simulation.faults.bays import FaultyBays
from depal.simulation.truth_sight import SightSettings

UNREAD = SightSettings(sigma=0.001, unrecognised=1.0)
"""Knows no box: all are shown to the reader."""

WHOLE_PHASES = [(name, phase) for name, entry in CATALOGUE.items() for phase in entry.phases]


def struck(fault: str, phase: Phase | None = None, *, seed: int = 0, **when: int) -> Outcome:
    """A tiny delivery in which a fault strikes."""
    plan = FaultPlan((Fault(fault, When(phase=phase, **when)),))
    sight = UNREAD if fault == "N1" else SightSettings(sigma=0.001, unrecognised=0.3)
    outcome = run(THREE, seed=seed, sight=sight, faults=plan)
    assert [each.fault.id for each in outcome.struck] == [fault]
    return outcome


@pytest.mark.slow
@pytest.mark.parametrize(("fault", "phase"), WHOLE_PHASES)
def test_a_fault_ends_as_its_entry_says_and_nothing_is_lost(fault: str, phase: Phase) -> None:
    """In every phase in which it can strike; the referee finds every box where the books say."""
    outcome = struck(fault, phase)
    assert list(broken_in(outcome)) == []
    assert verdict_of(outcome, fault).ended


@pytest.mark.slow
@pytest.mark.parametrize("phase", [Phase.REACH, Phase.CARRY, Phase.PLACE])
def test_after_an_emergency_stop_a_person_says_start_and_everything_is_stored(
    phase: Phase,
) -> None:
    """The arm stands still until then, and draws back before it goes on."""
    outcome = struck("M7", phase)
    assert [asked.question.id for asked in outcome.questions] == ["stopped/1"]
    assert outcome.stored == len(THREE)
    (asked,) = outcome.questions
    assert asked.answered is not None
    assert not [at for at in outcome.motions if asked.asked < at < asked.answered]


@pytest.mark.slow
def test_a_box_whose_label_nobody_can_read_goes_to_the_exception_place() -> None:
    """It is never guessed, and nobody is asked."""
    outcome = struck("N1", box=2)
    (aside,) = [gone for gone in outcome.departures if gone.fate is Fate.SET_ASIDE]
    assert outcome.stack[aside.box] == 2
    assert outcome.questions == ()


@pytest.mark.slow
def test_a_dropped_box_stops_all_motion_until_a_person_has_taken_it() -> None:
    """The referee has seen every motion begin."""
    outcome = struck("G3")
    (asked,) = outcome.questions
    assert asked.answered is not None
    assert not [at for at in outcome.motions if asked.asked < at < asked.answered]
    assert (outcome.stored, outcome.lost) == (2, 1)


@pytest.mark.slow
def test_a_store_that_is_silent_for_a_minute_loses_no_movement() -> None:
    """The arm works on while what is to be told waits."""
    plan = FaultPlan((Fault("W1", When(phase=Phase.TELL), duration=60.0),))
    outcome = run(THREE, faults=plan)
    assert outcome.stored == len(THREE)
    assert outcome.questions == ()
    assert list(broken_in(outcome)) == []


@pytest.mark.slow
def test_a_run_with_faults_is_the_same_for_the_same_seed() -> None:
    """To the byte of its event log."""
    plan = FaultPlan((Fault("G1", When(p=0.4)), Fault("M5", When(p=0.1)), Fault("W1", When(p=0.3))))
    one, same = (run(THREE, seed=3, faults=plan) for _ in range(2))
    assert one.struck == same.struck
    assert one.events_sha256 == same.events_sha256
    assert list(broken_in(one)) == []


@pytest.mark.slow
def test_a_box_goes_to_another_place_where_somebody_has_left_a_carton(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nothing is touched, nobody is asked; a cell whose range sensors see nothing runs into it."""
    plain = run(THREE, sight=SightSettings(sigma=0.001, unrecognised=0.3))
    outcome = struck("T2")
    assert (outcome.stored, outcome.questions, list(broken_in(outcome))) == (len(THREE), (), [])
    was = {plain.stack[gone.box]: gone.place for gone in plain.departures}
    now = {outcome.stack[gone.box]: gone.place for gone in outcome.departures}
    assert was != now

    async def blind(_: FaultyBays, place: PlaceId) -> tuple[float, ...]:
        del place
        return (math.inf,)

    monkeypatch.setattr(FaultyBays, "profile", blind)
    assert any(wrong.startswith("I5") for wrong in broken_in(struck("T2")))


@pytest.mark.slow
def test_an_arm_that_cannot_draw_back_is_not_waited_for_without_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Whatever goes wrong: a person is asked again, five times at the most for one stop."""

    def broken(_: Clearing) -> None:
        raise RuntimeError("no way is known")

    monkeypatch.setattr(Clearing, "ways_out", broken)
    outcome = run(THREE, faults=FaultPlan((Fault("M5", When(phase=Phase.REACH)),)))
    stops = [asked.question.text for asked in outcome.questions if asked.question.about == "arm"]
    assert 1 < len(stops) <= 5
    assert all("RuntimeError: no way is known" in text for text in stops[1:])
    assert list(broken_in(outcome)) == []
