"""The table of `depal bench perception`, and its JSON."""

import io
import json
import math
from dataclasses import replace

import pytest
from rich.console import Console

from depal.app.files import finite
from depal.app.reports.perception import perception_report
from depal.perception.faces import Facing
from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.perception_result import Result
from depal.studies.perception import Detected, Identities, Names, PoseError, RelationCounts, Score
from depal.studies.perception.real import FrameScore, Variant
from depal.studies.perception.scenes import FIRST_SEED, Measured, Piece, delivery_of, pieces
from depal.studies.statistics import Share


def score(right: int, wrong: int, missed: int) -> Score:
    """Of one look, with so many fronts and tops."""
    detected = Detected(Share(right, right + wrong), Share(right, right + missed))
    names = Identities(
        known={"printed": Names(19, 19, 0), "kraft": Names(8, 5, 1)}, unknown=Names(4, 0, 0)
    )
    return Score(
        1,
        dict.fromkeys(Facing, detected),
        tuple(PoseError(facing, 0.004, -0.002, -0.01, 0.001, grasp=True) for facing in Facing),
        names,
        RelationCounts(Share(9, 10), Share(10, 10)),
        RelationCounts(),
    )


def measured(kind: Kind, severity: Severity = Severity.NORMAL, first: float = 1.0) -> Measured:
    """Two looks at a scene of 33 faces."""
    return Measured(Piece(severity, kind, 7), 33, score(19, 1, 2), first, 0.4)


RESULT = Result(
    {
        Severity.NORMAL: [measured(Kind.FULL), measured(Kind.UNLOADED)],
        Severity.HARD: [measured(Kind.FULL, Severity.HARD)],
    },
    [measured(Kind.FULL), measured(Kind.FULL, first=1.4), measured(Kind.JUMBLED)],
    {"real": [FrameScore(Variant(), 12, 11, 1), FrameScore(Variant(8.0, 0.7), 12, 8, 2)]},
)


def test_figures_have_the_targets_of_their_severity() -> None:
    """Detection in both, everything else where it is normal."""
    figures = {figure.name: figure for figure in RESULT.figures}
    assert len(figures) == len(RESULT.figures)
    assert figures["normal: front faces: precision"].target == 0.95
    assert figures["hard: front faces: precision"].target == 0.90
    assert figures["normal: front faces: precision"].value == 0.95
    assert figures["normal: top faces: recall"].value == pytest.approx(19 / 21)
    assert figures["normal: top faces: recall"].n == 42
    assert figures["normal: front faces: centre sideways, p95"].value == pytest.approx(4.0)
    assert figures["normal: top faces: yaw, p95"].value == pytest.approx(math.degrees(0.01))
    assert figures["normal: top grasp faces: yaw, p95"].target == 1.0
    assert math.isnan(figures["normal: top faces: yaw, p95"].target)
    assert math.isnan(figures["hard: top grasp faces: yaw, p95"].target)
    assert figures["normal: known boxes named wrong"].value == pytest.approx(100 / 27)
    assert figures["normal: on top: precision"].value == 0.9
    assert math.isnan(figures["normal: occludes: recall"].value)
    assert not figures["normal: occludes: recall"].met


def test_times_and_real_frames_have_figures_of_their_own() -> None:
    """Medians; as it is, and at the worst."""
    figures = {figure.name: figure for figure in RESULT.figures}
    assert figures["first look, 33 visible faces"].value == 1.0
    assert figures["later look, 33 visible faces"].met
    assert figures["real: found of 12"].target == 10
    assert figures["real: found of 12"].met
    assert figures["real: false detections"].met
    assert not figures["real: found of 12, worst of 2 turns and lights"].met


def test_the_table_has_a_column_for_each_kind_and_says_how_it_counts() -> None:
    """A line for each quantity."""
    out = Console(width=150, record=True, file=io.StringIO())
    for part in perception_report(RESULT).shown:
        out.print(part)
    text = out.export_text()
    for words in (
        "perception, normal: 2 scenes",
        "full (1)",
        "unloaded (1)",
        "0.905",
        "0.779 .. 0.962",
        ">= 0.95",
        "1.00 (1.40)",
        "neither right nor wrong",
    ):
        assert words in text


def test_the_json_has_rows_by_severity_and_kind() -> None:
    """Beside the figures of the contract."""
    fields = json.loads(json.dumps(finite(perception_report(RESULT).fields)))
    assert {"part", "figures", "rows", "times", "frames"} == set(fields)
    kinds = {(row["severity"], row["kind"]) for row in fields["rows"]}
    assert kinds == {
        ("normal", "full"), ("normal", "unloaded"), ("normal", "all"),
        ("hard", "full"), ("hard", "all"),
    }  # fmt: skip
    row = next(row for row in fields["rows"] if row["name"] == "printed boxes named")
    assert (row["value"], row["unit"], row["n"]) == (100.0, "%", 19)
    assert len(row["ci95"]) == 2
    assert fields["times"] == [{"faces": [30, 39], "looks": 3, "first": 1.0, "later": 0.4}]
    assert fields["frames"][1]["turn"] == 8.0


def test_a_report_holds_when_every_target_is_met() -> None:
    """This one does not."""
    assert not perception_report(RESULT).holds
    assert perception_report(Result({})).holds


def test_scenes_are_of_every_kind_and_never_those_that_perception_was_tuned_on() -> None:
    """From two millions on; other seeds are other scenes."""
    asked = pieces(Severity.HARD, 7)
    assert [piece.seed for piece in asked] == list(range(FIRST_SEED, FIRST_SEED + 7))
    assert {piece.kind for piece in asked} == set(Kind)
    assert not {piece.seed for piece in asked} & {
        piece.seed for piece in pieces(Severity.HARD, 7, 1)
    }
    assert all(replace(piece, noted=False).seed >= 2_000_000 for piece in asked)


def test_some_scenes_are_of_real_deliveries() -> None:
    """Every fourth; each of those that ship in its turn."""
    names = [delivery_of(FIRST_SEED + number).id for number in range(0, 16, 4)]
    assert len(set(names)) == 4
    assert all(name.startswith("dev-") for name in names)
    assert delivery_of(FIRST_SEED + 1).id.startswith("random-")
