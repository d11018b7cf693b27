"""Cell files: what they mean, and what they say when something is wrong with them."""

import contextlib
import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

import depal.cell.files
from depal.cell.files import (
    SHIPPED,
    cell_of_yaml,
    cell_schema,
    find_cell,
    read_cell,
    shipped_cell,
    shipped_text,
)
from depal.cell.files.turns import looking, turned
from depal.domain import EURO_PALLET, LOWER, StorageKind, cell_from_pallet
from depal.errors import CellError

TEXT = shipped_text("default")


def told(text: str) -> list[str]:
    """Everything that is said about a text."""
    with pytest.raises(CellError) as caught:
        cell_of_yaml(text, "mine.yaml")
    assert caught.value.source == "mine.yaml"
    return [str(problem) for problem in caught.value.problems]


def edited(old: str, new: str) -> str:
    """The default cell with one passage replaced."""
    assert old in TEXT
    return TEXT.replace(old, new, 1)


def test_the_package_hands_out_these_names() -> None:
    """A change here is a change for its users."""
    assert sorted(depal.cell.files.__all__) == [
        "SHIPPED",
        "cell_of_yaml",
        "cell_schema",
        "find_cell",
        "read_cell",
        "shipped_cell",
        "shipped_text",
    ]


def test_the_default_is_the_papers_cell() -> None:
    """Six trolleys, three on each side, one shelf, a Euro pallet in front."""
    cell = shipped_cell()
    assert cell.floor == ((-2.5, -2.5), (2.5, 2.5))
    kinds = [storage.kind for storage in cell.storages]
    assert kinds.count(StorageKind.TROLLEY) == 6
    assert kinds.count(StorageKind.SHELF) == 1
    fronts = [storage.cell_from_storage.translation[1] for storage in cell.storages]
    assert sorted(fronts) == [-1.7, -1.7, -1.7, 0.0, 1.7, 1.7, 1.7]
    assert cell.pallet.size == EURO_PALLET
    assert cell.pallet.cell_from_pallet == cell_from_pallet(EURO_PALLET)
    assert cell.storage(cell.aside).id == "shelf"


def test_the_default_arm_has_the_published_limits() -> None:
    """Degrees in the file, radians in the cell; accelerations from the time to full speed."""
    limits = shipped_cell().robot.limits
    assert np.rad2deg(limits.lower) == pytest.approx([-185, -135, -120, -350, -119, -350])
    assert np.rad2deg(limits.upper) == pytest.approx([185, 35, 158, 350, 119, 350])
    assert np.rad2deg(limits.speed) == pytest.approx([128, 102, 128, 260, 245, 322])
    times = np.divide(limits.speed, limits.acceleration)
    assert times == pytest.approx([0.45, 0.45, 0.40, 0.30, 0.30, 0.25])


def test_a_plinth_raises_the_arm_and_stands_under_it() -> None:
    """Its shoulder, and what of it turns about axis 1; the block is as large as the base."""
    low, high = cell_of_yaml(edited("plinth: 0.15", "plinth: 0.0"), ""), shipped_cell()
    assert high.robot.geometry.c1 == pytest.approx(low.robot.geometry.c1 + 0.15)
    for one, other in zip(low.robot.shapes, high.robot.shapes, strict=True):
        rise = other.start[2] - one.start[2]
        assert rise == pytest.approx(0.15 if one.link <= 1 else 0.0)
    assert len(high.fixtures) == len(low.fixtures) + 1
    block = high.fixtures[-1].corners
    assert block.min(axis=0) == pytest.approx((-0.38, -0.32, 0.0))
    assert block.max(axis=0) == pytest.approx((0.38, 0.32, 0.15))


def test_the_lower_module_faces_down_and_folds_up_beside_the_front_one() -> None:
    """As the face frames say: x out of the face."""
    tool = shipped_cell().tool
    down = tool.module(LOWER).flange_from_face
    assert down.apply((0.05, 0.0, 0.0)) == (0.1, 0.0, -0.25)
    assert down.apply((0.0, 0.0, 0.1)) == (0.2, 0.0, -0.2)
    up = tool.module(LOWER, folded=True).flange_from_face
    assert up.apply((0.05, 0.0, 0.1)) == pytest.approx((0.25, 0.0, -0.1))
    assert tool.suction.cup_force == pytest.approx(84.8, abs=0.1)


@pytest.mark.parametrize("name", SHIPPED)
def test_solid_parts_of_the_tool_stay_behind_both_planes_of_touch(name: str) -> None:
    """By more than the stroke of the cups, in both positions of the hinge."""
    tool = shipped_cell(name).tool
    for shapes, folded in ((tool.shapes, False), (tool.folded_shapes, True)):
        corners = np.concatenate([shape.corners for shape in shapes])
        for module in tool.modules:
            face = tool.module(module.name, folded=folded).flange_from_face
            depths = [face.inverse.apply(tuple(corner))[0] for corner in corners.tolist()]
            assert max(depths) <= -0.015 + 1e-9


@pytest.mark.parametrize("name", SHIPPED)
def test_places_are_named_after_their_storage_and_rise(name: str) -> None:
    """And x leads into them, away from the robot."""
    for storage in shipped_cell(name).storages:
        heights = [place.cell_from_place.translation[2] for place in storage.places]
        assert heights == sorted(heights)
        for number, place in enumerate(storage.places, start=1):
            assert place.id == f"{storage.id}/level_{number}"
            middle = np.array(place.cell_from_place.translation[:2])
            inside = np.array(place.cell_from_place.apply((place.depth, 0.0, 0.0))[:2])
            assert np.linalg.norm(inside) > np.linalg.norm(middle)


@pytest.mark.parametrize("name", SHIPPED)
def test_places_are_empty_and_have_walls_and_a_floor(name: str) -> None:
    """A point inside is in no panel; just beyond the floor, the sides and the back one is."""
    for storage in shipped_cell(name).storages:
        storage_from_cell = storage.cell_from_storage.inverse
        for place in storage.places:
            width, height = place.opening
            low, high = 0.001, place.depth - 0.001

            def solid(x: float, y: float, z: float) -> bool:
                point = storage_from_cell.apply(place.cell_from_place.apply((x, y, z)))  # noqa: B023
                return any(
                    np.all(np.abs(np.subtract(point, panel.centre)) <= np.divide(panel.size, 2))
                    for panel in storage.panels  # noqa: B023
                )

            for x in (low, place.depth / 2, high):
                for y in (-width / 2 + 0.001, 0.0, width / 2 - 0.001):
                    assert not solid(x, y, 0.001)
                    assert not solid(x, y, height - 0.001)
                    assert solid(x, y, -0.001)
                assert solid(x, width / 2 + 0.001, height / 2)
                assert solid(x, -width / 2 - 0.001, height / 2)
            assert solid(place.depth + 0.001, 0.0, height / 2)


@pytest.mark.parametrize("name", SHIPPED)
def test_panels_stay_within_their_storage(name: str) -> None:
    """Width, depth and height over all are what the file says."""
    for storage in shipped_cell(name).storages:
        corners = np.concatenate([panel.corners for panel in storage.panels])
        width, depth, height = storage.size
        assert corners.min(axis=0) == pytest.approx([0.0, -width / 2, 0.005])
        assert corners.max(axis=0) == pytest.approx([depth, width / 2, height])


def test_everything_wrong_with_a_file_is_said_at_once_with_its_line() -> None:
    """Types, ranges, missing and unknown keys, in the order of the format."""
    text = edited("payload: 60", "payload: heavy")
    text = text.replace("  turn: 0\n", "  trun: 0\n", 1).replace(
        "speeds: {flange: 2.5, ", "speeds: {"
    )
    line = {key: text[: text.index(key)].count("\n") + 1 for key in ("heavy", "trun", "speeds:")}
    assert told(text) == [
        (
            f"line {line['heavy']}, robot.payload: 'heavy' is text, not a number; "
            "expected what the flange may carry, tool included [kg]"
        ),
        f"line {line['trun']}, pallet.trun: unknown key; did you mean 'turn'?",
        (
            f"line {line['speeds:']}, speeds.flange: is missing; expected of the flange in free "
            "space [m/s]"
        ),
    ]


MISTAKES = [
    ("lower: -185, upper: 185", "lower: 185, upper: 185", "lower 185 is not below upper 185"),
    ("parked: [-70", "parked: [-190", "-190 deg is outside the limits of the axis"),
    ("parked: [-70, ", "parked: [", "has 5 angles; expected 6 of them"),
    ("c1: 0.815", "c1: 815", "815 is above 20 m"),
    ("mass: 18\n", "mass: 60\n", "60 kg is all that the robot may carry"),
    ("aside: shelf", "aside: shelv", "there is no storage 'shelv'; did you mean 'shelf'?"),
    ("kind: shelf", "kind: rack", "'rack' is no kind of storage; expected trolley or shelf"),
    ("name: trolley_2", "name: trolley_1", "'trolley_1' is already the name of line"),
    ("trolley_2, model: trolley", "trolley_2, model: troley", "no model 'troley'; did you mean"),
    ("name: trolley_2", "name: a/b", "'a/b' is no name; expected letters, digits"),
    ("{floor: 1.05, height: 0.80}", "{floor: 1.02, height: 0.80}", "reaches into the level below"),
    ("{floor: 0.15, ", "{floor: 0.10, ", "0.1 m reaches into the base, which ends at 0.12 m"),
    (
        "1.05, height: 0.80}",
        "1.05, height: 0.90}",
        "highest level ends at 1.95 m, the storage at 1.85 m",
    ),
    ("wall: 0.02 ", "wall: 0.40 ", "the walls leave no room inside"),
    ("pitch: 0.10}", "pitch: 0.05}", "cups of 0.06 m overlap at a pitch of 0.05 m"),
    ("along_y: 3", "along_y: 4", "the cups are 0.36 m wide along y, the module 0.3"),
    ("look_at: [0.0, 0.0, 0.95]", "look_at: [1.20, -1.20, 0.95]", "is where the lens is"),
    ("upper: [2.5, 2.5]", "upper: [-2.5, 2.5]", "the floor has no extent along x"),
    ("vertical_view: 69", "vertical_view: 169", "169 is above 150 deg"),
    ("full_speed_in: 0.45", "full_speed_in: .nan", "NaN is not a finite number"),
    ("payload: 60", "payload: !kg 60", "the tag '!kg' has no meaning here"),
    ("payload: 60", "payload: 60\n  payload: 61", "the key stands here twice"),
    ("payload: 60", "payload: 0", "0 is below 0.001 kg"),
    ("stroke: 0.010", "stroke: true", "true is not a number"),
    ("name: default", "name: 7", "7 is a number"),
]


@pytest.mark.parametrize(("old", "new", "said"), MISTAKES)
def test_a_mistake_is_one_sentence_with_its_line(old: str, new: str, said: str) -> None:
    """That says what, where and what was expected."""
    problems = told(edited(old, new))
    assert len(problems) == 1
    assert said in problems[0]
    line = TEXT[: TEXT.index(old)].count("\n") + 1
    number = int(problems[0].removeprefix("line ").split(",")[0])
    assert abs(number - line) <= 4


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty; expected a cell: robot, tool, pallet, ..."),
        ("- a", "line 1: is not an object; expected a cell: robot, tool, ..."),
        ("a: [", "line 1, column 5: not YAML: expected the node content, but found"),
        ("a: &x [*x]", "too deep or too large to be a cell"),
        ("{" * 1050, "too deep to be a cell"),
        ("[a, b]: 1\nname: x", "line 1, ['a list']: unknown key"),
    ],
)
def test_what_is_no_cell_is_refused(text: str, said: str) -> None:
    """Instead of guessed at."""
    assert said in "\n".join(told(text))


def test_aliases_of_aliases_cannot_fill_the_memory() -> None:
    """A few lines can stand for billions of values."""
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 9)]
    assert "too large" in told("\n".join(lines))[0]


@given(st.text())
def test_any_text_is_a_cell_or_a_cell_error(text: str) -> None:
    """Never another exception."""
    with pytest.raises(CellError):
        cell_of_yaml(text, "")


@settings(max_examples=25)
@given(st.data())
def test_a_file_with_any_value_replaced_is_a_cell_or_a_cell_error(data: st.DataObject) -> None:
    """Whatever stands wherever."""
    cell = yaml.safe_load(TEXT)
    node = cell
    while True:
        keys = list(node) if isinstance(node, dict) else list(range(len(node)))
        key = data.draw(st.sampled_from(keys))
        if not isinstance(node[key], dict | list) or not node[key] or data.draw(st.booleans()):
            break
        node = node[key]
    node[key] = data.draw(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.lists(st.none())
    )
    with contextlib.suppress(CellError):
        cell_of_yaml(yaml.safe_dump(cell), "")


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_cells_follow_the_schema(name: str) -> None:
    """What an editor checks while typing."""
    schema = cell_schema()
    Draft202012Validator.check_schema(schema)
    Draft202012Validator(schema).validate(yaml.safe_load(shipped_text(name)))
    fields = [part["properties"].values() for part in schema["$defs"].values()]
    assert all(field["description"] for part in fields for field in part)


def test_the_schema_refuses_what_the_reader_refuses() -> None:
    """As far as a schema can."""
    validator = Draft202012Validator(cell_schema())
    for old, new in (("c1: 0.815", "c1: 815"), ("kind: shelf", "kind: rack"), ("payload", "load")):
        assert not validator.is_valid(yaml.safe_load(edited(old, new)))


def test_a_cell_is_found_by_its_file_or_its_name(tmp_path: Path) -> None:
    """A file of exactly this name wins."""
    path = tmp_path / "mine.yaml"
    path.write_text(edited("name: default", "name: mine"), encoding="utf-8")
    assert read_cell(path).name == find_cell(str(path)).name == "mine"
    assert dataclasses.replace(find_cell(str(path)), name="default") == find_cell("default")


@pytest.mark.parametrize(
    ("reference", "said"),
    [
        ("defalt", "neither a file nor a shipped cell is called 'defalt'"),
        ("defalt", "did you mean 'default'?"),
        ("nowhere/cell.yaml", "no such file"),
        ("cell.yml", "no such file"),
        ("a\0b", "neither a file nor a shipped cell"),
    ],
)
def test_a_cell_that_does_not_exist_is_refused(
    reference: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With what exists."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(CellError, match=re.escape(said)):
        find_cell(reference)


def test_an_unknown_shipped_cell_is_refused() -> None:
    """By name alone."""
    with pytest.raises(CellError, match="no shipped cell is called 'x'"):
        shipped_cell("x")


@given(
    st.tuples(*[st.floats(-3, 3)] * 3),
    st.tuples(*[st.floats(-3, 3)] * 3),
)
def test_a_lens_looks_at_its_target_with_an_upright_picture(
    at: tuple[float, float, float], target: tuple[float, float, float]
) -> None:
    """Its z leads to the target, its x is level, its y is not upwards."""
    if math.dist(at, target) < 0.01:
        return
    pose = looking(at, target)
    assert pose.apply((0.0, 0.0, math.dist(at, target))) == pytest.approx(target, abs=1e-6)
    turn = np.array(pose.rotation)
    assert turn.T @ turn == pytest.approx(np.eye(3), abs=1e-6)
    assert np.linalg.det(turn) == pytest.approx(1.0)
    assert turn[2, 0] == pytest.approx(0.0, abs=1e-6)
    assert turn[2, 1] <= 1e-6


@given(st.integers(-8, 8), st.integers(-8, 8), st.integers(-8, 8))
def test_quarter_turns_are_exact(roll: int, pitch: int, yaw: int) -> None:
    """Right angles in a file stay right angles in the cell."""
    pose = turned((0.0, 0.0, 0.0), roll=90 * roll, pitch=90 * pitch, yaw=90 * yaw)
    assert sorted(abs(entry) for row in pose.rotation for entry in row) == [0.0] * 6 + [1.0] * 3


def test_a_fiducial_lies_on_the_floor_or_hangs_upright() -> None:
    """Its own frame: x right and y down as one looks at it, z into its plate."""
    cell = shipped_cell()
    flat, hung = cell.fiducials[0], cell.fiducials[5]
    assert flat.cell_from_marker.rotation == ((0, -1, 0), (-1, 0, 0), (0, 0, -1))
    assert hung.cell_from_marker.rotation == ((0, 0, 1), (-1, 0, 0), (0, -1, 0))
    text = edited("normal: [0, 0, 1]}", "normal: [0, 0, 0.5], turn: 90}")
    turned_once = cell_of_yaml(text, "").fiducials[0].cell_from_marker
    assert turned_once.rotation == ((-1, 0, 0), (0, 1, 0), (0, 0, -1))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("{id: 1, size: 0.15", "{id: 0, size: 0.15", "0 is already the pattern of line"),
        ("{id: 1, size: 0.15", "{id: 50, size: 0.15", "50 is above 49"),
        ("normal: [0, 0, 1]}", "normal: [0, 0, 0]}", "points nowhere; expected a direction"),
        ("normal: [0, 0, 1]}", "normal: [0, 1]}", "2 numbers"),
        ("{id: 1, size: 0.15", "{id: 1, size: 0", "fiducials[1].size"),
    ],
)
def test_a_fiducial_that_cannot_be_is_told(old: str, new: str, said: str) -> None:
    """One problem each."""
    (problem,) = told(edited(old, new))
    assert "fiducials[" in problem
    assert said in problem
