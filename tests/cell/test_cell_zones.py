"""Zones in a cell file: read, checked, refused where they cannot be."""

import dataclasses
import math

import jsonschema
import numpy as np
import pytest

from depal.cell.checking.check import check_cell
from depal.cell.checking.findings import CellFinding, Weight
from depal.cell.checking.mover import Mover
from depal.cell.checking.sizes import USUAL
from depal.cell.checking.standing import check_standing
from depal.cell.files import SHIPPED, cell_of_yaml, cell_schema, shipped_cell, shipped_text
from depal.cell.files.yaml_tree import tree_of_yaml
from depal.domain import CellLayout, Zone
from depal.errors import CellError
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Scene, fixed_solids

AISLE = "{name: aisle, centre: [1.1, 0.65, 1.2], size: [0.6, 0.1, 2.4], turn: 90}"


def text_with(*zones: str) -> str:
    """The default cell's file with some zones at its end."""
    lines = [f"  - {zone}\n" for zone in zones]
    return f"{shipped_text('default')}zones:\n{''.join(lines)}"


def layout_with(*solids: OrientedBox) -> CellLayout:
    """The default cell with some zones."""
    zones = tuple(Zone(f"zone_{number}", solid) for number, solid in enumerate(solids))
    return dataclasses.replace(shipped_cell(), zones=zones)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_cells_have_no_zones(name: str) -> None:
    """They behave as ever."""
    assert shipped_cell(name).zones == ()


def test_a_zone_is_read_where_it_is_and_follows_the_schema() -> None:
    """Turned about the vertical through its middle."""
    text = text_with(AISLE)
    (zone,) = cell_of_yaml(text, "mine.yaml").zones
    assert zone.name == "aisle"
    low, high = zone.solid.corners.min(axis=0), zone.solid.corners.max(axis=0)
    assert np.allclose(low, (1.05, 0.35, 0.0))
    assert np.allclose(high, (1.15, 0.95, 2.4))
    schema = jsonschema.Draft202012Validator(cell_schema())
    assert list(schema.iter_errors(tree_of_yaml(text, "").value)) == []


@pytest.mark.parametrize(
    ("zones", "said"),
    [
        ((AISLE, AISLE), "'aisle' is already the name of line"),
        ((AISLE.replace("aisle", "the-aisle"),), "'the-aisle' is no name; expected letters"),
        ((AISLE.replace("aisle", "''"),), "is empty; expected letters, digits and _"),
        ((AISLE.replace("0.1, 2.4", "0.0, 2.4"),), "0 is below 0.001 m"),
        ((AISLE.replace("centre", "center"),), "unknown key; did you mean 'centre'?"),
    ],
)
def test_a_zone_that_cannot_be_is_told(zones: tuple[str, ...], said: str) -> None:
    """With its line."""
    with pytest.raises(CellError) as refused:
        cell_of_yaml(text_with(*zones), "mine.yaml")
    assert said in str(refused.value)
    assert "zones[" in str(refused.value)


def test_a_zone_around_the_robots_base_is_an_error() -> None:
    """Nothing could keep out of it."""
    layout = layout_with(OrientedBox(Pose((0.3, 0.0, 0.3)), (0.5, 0.5, 0.5)))
    (finding,) = check_standing(layout)
    assert finding.weight is Weight.ERROR
    assert "zone zone_0: holds the robot's base" in str(finding)


def test_a_zone_around_the_parked_arm_is_worth_a_warning() -> None:
    """A task that avoids it could not begin."""
    there = OrientedBox(Mover(shipped_cell())._body.kinematics.flange(PARKED), (0.3, 0.3, 0.3))  # noqa: SLF001
    away = OrientedBox(Pose((2.2, 2.2, 0.5)), (0.2, 0.2, 0.2))
    layout = layout_with(there, away)
    assert Mover(layout).parked_in() == ("zone_0",)
    found = [each for each in check_cell(layout, USUAL[:1]).findings if is_about_zones(each)]
    assert [each.weight for each in found] == [Weight.WARNING]
    assert "zone zone_0: the parked arm reaches into it" in str(found[0])


PARKED = shipped_cell().robot.parked


def is_about_zones(finding: CellFinding) -> bool:
    """Whether it is about a zone."""
    return str(finding.problem).startswith("zone")


def test_a_zone_is_solid_to_planners_and_not_a_case_to_rub_along() -> None:
    """It has its name in reasons; the scene's zones can be looked at alone."""
    layout = layout_with(OrientedBox(Pose((1.0, 0.5, 1.0)), (0.1, 0.2, 0.3)))
    scene = Scene.of(fixed_solids(layout), [("b1", OrientedBox(Pose((1.6, 0, 1)), (0.3,) * 3))])
    assert scene.with_zones([]) is scene
    with_zones = scene.with_zones(layout.zones)
    assert with_zones.names == (*scene.names, "zone zone_0")
    assert with_zones.pile.tolist() == [*scene.pile.tolist(), False]
    assert with_zones.zones.names == ("zone zone_0",)
    assert np.allclose(with_zones.zones.solids.half, [(0.05, 0.1, 0.15)])
    assert scene.zones.names == ()
    assert math.isclose(float(with_zones.zones.solids.centre[0, 1]), 0.5)
