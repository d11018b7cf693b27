"""`depal learn`: what files and records may hold, and what comes of them."""

import json
from pathlib import Path

import pytest

from depal.app.learning import (
    learn_from,
    learn_report,
    order_schema,
    read_orders,
    recovery_report,
    weights_of,
    write_orders,
)
from depal.domain import BoxId, Detection, Request
from depal.errors import OrderError, SettingError
from depal.geometry import OrientedBox
from depal.selection import PAPER_WEIGHTS, BlockingGraph, ScoreRule, leaf_alone, select
from depal.selection.learning import Finding
from depal.studies.drawing import save_figure
from depal.studies.learning import Teacher, draw_order, recover

TEACHER = Teacher(0.5, PAPER_WEIGHTS, 0.02)

GOOD = {
    "pallet": "p",
    "boxes": [
        {"box": "a", "centre": [1.6, 0.1, 0.1], "size": [0.4, 0.3, 0.2]},
        {"box": "b", "centre": [1.6, 0.6, 0.1], "size": [0.4, 0.3, 0.2], "yaw": 0.1},
    ],
    "requests": [{"box": "a", "priority": 0.5}],
    "order": ["b", "a"],
}


def written(path: Path, *lines: object) -> Path:
    """A file of orders."""
    path.write_text("".join(f"{json.dumps(line)}\n" for line in lines), "utf-8")
    return path


def test_orders_survive_a_file(tmp_path: Path) -> None:
    """Written and read they give the same choices."""
    orders = [draw_order(TEACHER, 1, index) for index in range(5)]
    write_orders(tmp_path / "o.jsonl", orders, "--orders")
    again = read_orders(tmp_path / "o.jsonl")
    for one, two in zip(orders, again, strict=True):
        assert one.departures == two.departures
        assert one.requests == two.requests
        assert [box.id for box in one.boxes] == [box.id for box in two.boxes]
        assert one.tolerances.overlap == two.tolerances.overlap


def test_what_was_drawn_is_learned_from_its_file_and_checked(tmp_path: Path) -> None:
    """With a table, a picture and JSON."""
    orders = [draw_order(TEACHER, 2, index) for index in range(25)]
    write_orders(tmp_path / "o.jsonl", orders, "--orders")
    lesson = learn_from([tmp_path / "o.jsonl"], resamples=5)
    learned = lesson.learned
    assert learned.finding is Finding.ESTIMATED
    assert learned.w.value == pytest.approx(0.5, abs=0.1)
    assert learned.height.value == pytest.approx(4 / 7, abs=0.1)
    assert learned.w.low < learned.w.value < learned.w.high
    assert lesson.check is not None
    assert lesson.check.pallets == 5
    assert lesson.check.taken.value > lesson.check.by_chance + 0.2
    report = learn_report(lesson, 1.0)
    assert report.holds
    assert report.draw is not None
    save_figure(report.draw(), tmp_path / "o.png")
    assert report.fields["pallets"] == 25


def test_orders_of_people_may_take_what_the_model_calls_blocked(tmp_path: Path) -> None:
    """Such boxes are counted and not used; times are needed where a request comes later."""
    front = {"box": "c", "centre": [1.2, 0.1, 0.1], "size": [0.3, 0.3, 0.2]}
    line = {**GOOD, "boxes": [*GOOD["boxes"], front], "order": ["a", "c", "b"]}
    late = {**line, "requests": [{"at": 5.0, "box": "b", "priority": 1}], "times": [1, 6, 7]}
    lesson = learn_from([written(tmp_path / "o.jsonl", line, late)])
    assert (lesson.pallets, lesson.blocked, lesson.forced) == (2, 2, 2)
    assert lesson.check is None
    said = "\n".join(str(part) for part in learn_report(lesson, 0.0).shown[1:])
    assert "2 boxes left while another stood on or before them" in said
    assert "Too few pallets" in said


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"order": ["b", "d"]}, "line 1, order[1]: no box is called 'd'; expected one of the"),
        ({"order": ["b", "b"]}, "line 1, order[1]: 'b' has left before; expected each box once"),
        ({"order": []}, "line 1, order: has no boxes"),
        ({"times": [1.0]}, "line 1, times: has 1 times for 2 boxes"),
        ({"times": [2.0, 1.0]}, "line 1, times: go back; expected the first time first"),
        ({"requests": [{"at": 3, "box": "a", "priority": 1}]}, "line 1, times: are missing"),
        ({"requests": [{"box": "x", "priority": 1}]}, "line 1, requests[0].box: no box is called"),
        ({"requests": [{"priority": 1}]}, "line 1, requests[0]: neither gtin nor box"),
        (
            {"requests": [{"box": "a", "priority": 1, "at": 3, "due": 1}], "times": [1, 2]},
            "requests[0].due: 1 s is before the request comes; expected 3 s or later",
        ),
        ({"boxes": [GOOD["boxes"][0]] * 2}, "line 1, boxes[1].box: two boxes are called 'a'"),
        ({"palet": 1}, "line 1, palet: unknown key; did you mean 'pallet'?"),
        ({"tolerance": 3}, "line 1, tolerance: 3 is not between 0 and 0.1 m"),
        (
            {"boxes": [GOOD["boxes"][0], {**GOOD["boxes"][0], "box": "b"}]},
            "line 1, boxes: boxes 'a' and 'b' are in one place",
        ),
    ],
)
def test_what_is_wrong_with_a_line_is_said(
    tmp_path: Path, change: dict[str, object], message: str
) -> None:
    """What, where, expected, exists."""
    with pytest.raises(OrderError) as caught:
        read_orders(written(tmp_path / "o.jsonl", {**GOOD, **change}))
    assert message in str(caught.value)


def test_what_is_no_record_is_answered_with_what_is(tmp_path: Path) -> None:
    """Files, folders, old records."""
    cases = {
        "missing.jsonl": "no such file",
        "empty.jsonl": "is empty; expected one pallet a line, as JSON",
        "text.jsonl": "line 1: is no JSON at column 1",
        "o.csv": "is no record: .csv; expected a folder of a record or a .jsonl file",
        "folder": "holds no choices.jsonl; expected the folder of a record",
        "old": "line 1: has no choice with the boxes' places; expected a record of this version",
    }
    (tmp_path / "empty.jsonl").write_text("")
    (tmp_path / "text.jsonl").write_text("hello")
    (tmp_path / "o.csv").write_text("")
    (tmp_path / "folder").mkdir()
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "choices.jsonl").write_text('{"at": 1, "target": "b"}\n')
    for name, message in cases.items():
        with pytest.raises(OrderError) as caught:
            learn_from([tmp_path / name])
        assert message in str(caught.value)


def test_a_record_of_runs_is_read_in_one_folder_or_many(tmp_path: Path) -> None:
    """As the cell notes choices."""
    boxes = [
        Detection(BoxId(name), OrientedBox.from_corner((1.4, y, 0.0), (0.4, 0.3, height)))
        for name, y, height in (("a", -0.5, 0.3), ("b", 0.0, 0.4), ("c", 0.4, 0.2))
    ]
    from depal.app.run.record import Keeper  # noqa: PLC0415 - the record's own writer
    from depal.cell.reporting import note_of  # noqa: PLC0415

    for name in ("one", "two"):
        graph = BlockingGraph(boxes)
        folder = tmp_path / "all" / name
        folder.mkdir(parents=True)
        keeper = Keeper(folder, None)  # type: ignore[arg-type] - no events here
        while len(graph):
            wish = [Request(priority=0.9, box=BoxId("c"))] if BoxId("c") in graph else []
            decision = select(graph, wish, ScoreRule(0.5, 2.2), leaf_alone)
            keeper.choices.append(note_of(0.0, decision))
            assert decision.target is not None
            graph.remove(decision.target.id)
        keeper.write_choices()
    lesson = learn_from([tmp_path / "all"])
    assert (lesson.pallets, lesson.forced, lesson.learned.choices) == (2, 2, 4)
    assert learn_from([tmp_path / "all" / "one"]).learned.choices == 2
    assert lesson.learned.finding is Finding.NOISELESS


def test_a_known_policy_is_recovered_and_reported() -> None:
    """As `depal study learning` does."""
    results = recover(TEACHER, 40, range(2))
    report = recovery_report(TEACHER, 40, results, 1.0)
    rows = report.fields["rows"]
    assert isinstance(rows, list)
    assert [row["weight"] for row in rows if isinstance(row, dict)] == [
        "w",
        "side",
        "depth",
        "height",
    ]
    assert all(result.relative["height"] < 0.1 for result in results)
    assert results[0].followed.value > 0.5
    assert recover(TEACHER, 3, [1]) == recover(TEACHER, 3, [1])


def test_settings_of_a_teacher_are_checked() -> None:
    """Each with its range."""
    assert weights_of("1,2,4") == PAPER_WEIGHTS
    for text in ("1,2", "a,b,c", "-1,1,1", "0,0,0", "inf,1,1"):
        with pytest.raises(SettingError, match="three numbers, 0 or more and not all 0"):
            weights_of(text)
    with pytest.raises(SettingError, match=r"temperature: -1\.0 m; expected 0 m or more"):
        Teacher(0.5, PAPER_WEIGHTS, -1.0)
    assert order_schema()["required"] == ["pallet", "boxes", "order"]
