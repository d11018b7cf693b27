"""Files of faults: what they say is what strikes, and errors teach."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import FaultError
from depal.simulation.faults import CATALOGUE, Fault, FaultPlan, Phase, When, read_faults
from depal.simulation.faults.chances import Chances


def written(folder: Path, text: str) -> Path:
    """A file of faults."""
    path = folder / "faults.yaml"
    path.write_text(text, "utf-8")
    return path


def test_the_examples_of_the_design_are_read(tmp_path: Path) -> None:
    """Both lines of DESIGN's format, and what was added."""
    text = """
- {fault: G3, when: {box: 4, phase: carry}}
- {fault: P1, when: {p: 0.02}, duration: 3 s}
- fault: M7
- {fault: C3, when: {nth: 4}}
"""
    assert read_faults(written(tmp_path, text)) == FaultPlan(
        (
            Fault("G3", When(box=4, phase=Phase.CARRY)),
            Fault("P1", When(p=0.02), duration=3.0),
            Fault("M7"),
            Fault("C3", When(nth=4)),
        )
    )


def test_all_that_is_wrong_is_said_at_once(tmp_path: Path) -> None:
    """Each with its line, and with what there is instead."""
    text = """
- {fault: G33}
- {fault: G3, when: {phase: cary, p: 2}}
- {fault: P1, when: {box: 1}, duration: soon}
- {fault: G3, when: {phase: look}, tune: 3}
- {when: {step: -1, nth: 0}}
"""
    with pytest.raises(FaultError) as caught:
        read_faults(written(tmp_path, text))
    said = [str(problem) for problem in caught.value.problems]
    assert [line.split(":")[0] for line in said] == [
        "line 2, [0].fault",
        "line 3, [1].when.p",
        "line 3, [1].when.phase",
        "line 4, [2].when.box",
        "line 4, [2].duration",
        "line 5, [3].when.phase",
        "line 5, [3].tune",
        "line 6, [4].fault",
        "line 6, [4].when.step",
        "line 6, [4].when.nth",
    ]
    assert "did you mean 'G3'" in said[0]
    assert "did you mean 'carry'" in said[2]
    assert "expected carry" in said[5]


@pytest.mark.parametrize(
    "text", ["", "fault: G3", "- G3", "- [G3]", "- {fault: [1]}", "- {a: !x b"]
)
def test_what_is_no_list_of_faults_is_refused(tmp_path: Path, text: str) -> None:
    """Never with anything but a FaultError."""
    with pytest.raises(FaultError):
        read_faults(written(tmp_path, text))


@given(p=st.floats(0.0, 1.0), seed=st.integers(0, 1000))
def test_the_same_seed_strikes_at_the_same_chances(p: float, seed: int) -> None:
    """And with p = 0 never, with p = 1 always."""

    def struck() -> list[bool]:
        chances = Chances(FaultPlan((Fault("G1", When(p=p)),)), seed, lambda: 0.0)
        return [chances.strikes("G1", Phase.GRASP, 0) is not None for _ in range(20)]

    assert struck() == struck()
    assert p > 0.0 or not any(struck())
    assert p < 1.0 or all(struck())


def test_a_fault_without_p_strikes_once_at_its_first_chance() -> None:
    """Whatever else is asked of it."""
    now = [0.0]
    plan = FaultPlan((Fault("G3", When(box=2, step=1, time=5.0)),))
    chances = Chances(plan, 0, lambda: now[0])
    assert chances.strikes("G3", Phase.CARRY, 2) is None
    chances.step, now[0] = 1, 5.0
    assert chances.strikes("G3", Phase.CARRY, 1) is None
    assert chances.strikes("G3", Phase.LOOK, 2) is None
    assert chances.strikes("M5", Phase.CARRY, 2) is None
    assert chances.strikes("G3", Phase.CARRY, 2) is not None
    assert chances.strikes("G3", Phase.CARRY, 2) is None


@given(nth=st.integers(1, 20), other=st.integers(0, 5))
def test_a_fault_may_wait_for_a_later_chance(nth: int, other: int) -> None:
    """Chances at which not all else holds do not count."""
    chances = Chances(FaultPlan((Fault("C3", When(step=1, nth=nth)),)), 0, lambda: 0.0)
    for _ in range(other):
        assert chances.strikes("C3", Phase.WRITE) is None
    chances.step = 1
    struck = [chances.strikes("C3", Phase.WRITE) is not None for _ in range(nth + 3)]
    assert struck.index(True) == nth - 1
    assert sum(struck) == 1


def test_what_lasts_is_over_in_time_or_when_a_person_has_mended_it() -> None:
    """A second one may follow."""
    now = [0.0]
    plan = FaultPlan((Fault("P1", duration=3.0), Fault("P1", When(time=5.0), duration=100.0)))
    chances = Chances(plan, 0, lambda: now[0])
    seen = []
    for at in (0.0, 2.9, 3.1, 5.0, 50.0):
        now[0] = at
        seen.append(chances.lasts("P1", Phase.LOOK) is not None)
    assert seen == [True, True, False, True, True]
    chances.mended(["P1"])
    assert chances.lasts("P1", Phase.LOOK) is None


def test_every_entry_of_the_catalogue_can_strike_and_end() -> None:
    """It has a phase and a way to end."""
    assert all(entry.phases and entry.ends for entry in CATALOGUE.values())
    assert all(entry.id == name for name, entry in CATALOGUE.items())
