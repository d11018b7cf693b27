"""`depal replay --why`: what a record tells of its choices."""

from pathlib import Path

import pytest

from depal.app.run.record import Keeper
from depal.app.whys import decided_again, why_report
from depal.cell.reporting import note_of
from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition, Request
from depal.errors import JournalError
from depal.geometry import OrientedBox
from depal.selection import BlockingGraph, LeafAlone, Refused, ScoreRule, select

TEA = Gtin("12000900000013")


def _at(name: str, y: float, low: float, height: float) -> OrientedBox:
    del name
    return OrientedBox.from_corner((1.4, y, low), (0.4, 0.3, height))


BOXES: list[Perceived] = [
    Detection(BoxId("low"), _at("low", 0.0, 0.0, 0.2)),
    Recognition(BoxId("high"), _at("high", 0.0, 0.2, 0.2), TEA),
    Detection(BoxId("aside"), _at("aside", -0.5, 0.0, 0.7)),
    Detection(BoxId("far"), _at("far", 0.5, 0.0, 0.3)),
]


@pytest.fixture(name="record")
def _record(tmp_path: Path) -> Path:
    """A run in which nobody ever gets hold of one box."""

    def grasp_for(box: Perceived) -> LeafAlone | Refused:
        return Refused("out of reach") if box.id == "far" else LeafAlone()

    graph = BlockingGraph(BOXES)
    keeper = Keeper(tmp_path, None)  # type: ignore[arg-type] - no events here
    wish = Request(priority=0.8, box=BoxId("low"))
    for number in range(4):
        wanted = [wish] if BoxId("low") in graph else []
        decision = select(graph, wanted, ScoreRule(0.5, 2.2), grasp_for)
        keeper.choices.append(note_of(8.0 * number, decision))
        if decision.target is not None:
            graph.remove(decision.target.id)
    keeper.write_choices()
    return tmp_path


def words(record: Path, what: str) -> str:
    """Everything that is said besides tables."""
    return "\n".join(str(part) for part in why_report(record, what).shown)


def test_a_choice_is_explained_from_the_record(record: Path) -> None:
    """With the parts of the score, the runner-up, and what would have changed it."""
    said = words(record, "1")
    assert "high: chosen (the best score of all boxes that can be grasped)" in said
    assert "l = 0.800 (request for box low)" in said
    assert "0.371 above the runner-up aside" in said
    assert "without the request for box low aside is chosen" in said
    fields = why_report(record, "1").fields["choices"]
    assert isinstance(fields, list)
    assert isinstance(fields[0], dict)
    explanation = fields[0]["explanation"]
    assert isinstance(explanation, dict)
    assert explanation["box"] == "high"
    assert fields[0]["lines"]


def test_a_box_is_followed_until_it_is_chosen(record: Path) -> None:
    """Blocked, then chosen."""
    said = words(record, "low")
    assert "low: blocked (high on top)" in said
    assert "must leave first: high" in said
    assert "were box high gone, low is chosen" in said
    assert "Choice 2 at 8.0 s" in said
    assert "low: chosen" in said
    assert "far: no reachable grasp (out of reach)" in words(record, "far")


def test_every_choice_has_a_line(record: Path) -> None:
    """The last one has no box."""
    fields = why_report(record, "all").fields["choices"]
    assert isinstance(fields, list)
    targets = [field["target"] for field in fields if isinstance(field, dict)]
    assert targets == ["high", "low", "aside", None]
    assert "nothing can be grasped" in words(record, "4")


def test_a_choice_that_the_papers_rule_would_not_make_is_told_and_not_explained(
    record: Path,
) -> None:
    """By another policy: what was recorded, no more."""
    path = record / "choices.jsonl"
    first = path.read_text().splitlines()[0]
    for change in (
        ('"by_score":true', '"by_score":false'),
        ('"scored lower than high"', '"scored lower than all"'),
    ):
        path.write_text(first.replace(*change) + "\n")
        assert words(record, "low") == "Choice 1 at 0.0 s\nlow: blocked (high on top)"
    weights = {"side": 0.2, "depth": 0.3, "height": 0.5}
    empty = {"lines": [], "w": 0.5, "x_max": 2.2, "requests": [], "weights": weights}
    assert decided_again({**empty, "by_score": True}) is not None
    assert decided_again({**empty, "by_score": False}) is None


@pytest.mark.parametrize(
    ("what", "message"),
    [
        ("9", "there is no choice 9; it has 1 .. 4"),
        ("hihg", "no choice and no box 'hihg'; did you mean 'high'?"),
    ],
)
def test_what_does_not_exist_is_answered_with_what_does(
    record: Path, what: str, message: str
) -> None:
    """Choices and boxes."""
    with pytest.raises(JournalError) as caught:
        why_report(record, what)
    assert message in str(caught.value)


def test_what_is_no_record_is_said(tmp_path: Path) -> None:
    """No file, no JSON, an old record."""
    with pytest.raises(JournalError, match="expected a record of `depal run`"):
        why_report(tmp_path, "all")
    path = tmp_path / "choices.jsonl"
    path.write_text("{")
    with pytest.raises(JournalError, match="is no record's list of choices"):
        why_report(tmp_path, "all")
    path.write_text('{"at": 0}\n')
    with pytest.raises(JournalError, match="has no explanations"):
        why_report(tmp_path, "all")
