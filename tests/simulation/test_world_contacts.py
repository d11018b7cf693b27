"""Collisions are counted as the cell defines them, and losses with their reason."""

from dataclasses import replace

import pytest
from simulated_layouts import PARKED, point_to_point, radians
from simulated_worlds import hanging, shifted, world_of

from depal.domain import FRONT
from depal.geometry import Pose
from depal.simulation.losses import Cause
from depal.simulation.world import World


def beside_a_wall(gap: float, mass: float = 40.0) -> World:
    """A held box in front of another that is too heavy to be pushed away easily."""
    world = hanging(FRONT, (0.2, 0.3, 0.2), 2.0, others=(((0.0, 0.0, 0.0), (0.3, 0.3, 0.3), mass),))
    x, y, z = world.box(0).translation
    world.place_box(1, Pose((x + 0.25 + gap, y, z)))
    world.model.mj.opt.gravity[2] = 0.0
    world.advance(world.now + 0.02)
    return world


def test_a_held_box_that_touches_outside_the_straight_parts_collides() -> None:
    """Once, however long the contact lasts."""
    world = beside_a_wall(0.002)
    world.begin(shifted(world, (0.003, 0, 0), 0.5))
    world.advance(world.now + 0.6)
    (collision,) = world.contacts.collisions
    assert (collision.who, collision.against) == ("box 0", "box 1")
    assert collision.held
    assert not collision.allowed
    assert collision.force > 0.0


def test_a_held_box_may_touch_within_a_straight_part() -> None:
    """The same motion with an allowance is none."""
    world = beside_a_wall(0.002)
    motion = replace(shifted(world, (0.003, 0, 0), 0.5), allowances=((0.0, 0.5),))
    world.begin(motion)
    world.advance(world.now + 0.6)
    assert world.contacts.collisions == []


def test_a_straight_part_allows_no_more_than_fifty_newtons() -> None:
    """Pushing hard is a collision everywhere."""
    world = beside_a_wall(0.002, mass=4000.0)
    motion = replace(shifted(world, (0.006, 0, 0), 0.3), allowances=((0.0, 0.3),))
    world.begin(motion)
    world.advance(world.now + 0.4)
    (collision,) = world.contacts.collisions
    assert collision.allowed
    assert collision.force > 50.0
    assert world.contacts.greatest > 50.0


def test_an_arm_that_touches_anything_collides_whatever_the_straight_parts_allow() -> None:
    """Here the tool sweeps through a box on the pallet."""
    world = world_of(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), joints=radians(0, -40, 60, 0, 0, 0))
    flange = world.flange().translation
    world.place_box(0, Pose((flange[0] + 0.1, flange[1] - 0.5, flange[2])))
    world.model.mj.opt.gravity[2] = 0.0
    start = world.joints()
    end = (start[0] + 0.4, *start[1:])
    motion = replace(point_to_point(start, end, 1.0), allowances=((0.0, 1.0),))
    world.begin(motion)
    world.advance(1.2)
    assert [(c.who, c.against) for c in world.contacts.collisions][:1] == [("tool", "box 0")]


def test_an_arm_in_the_free_touches_nothing() -> None:
    """Nor do its links count their neighbours."""
    world = world_of(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), joints=PARKED)
    world.begin(point_to_point(PARKED, radians(-120, -102, 125, 60, 80, 30), 1.5))
    world.advance(2.0)
    assert world.contacts.collisions == []


def test_a_box_shaken_off_is_lost_by_acceleration() -> None:
    """Nothing touched it."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 9.0)
    start = world.joints()
    world.begin(point_to_point(start, (start[0] + 0.1, *start[1:]), 0.15))
    world.advance(world.now + 2.0)
    (loss,) = world.losses.lost
    assert (loss.box, loss.cause) == (0, Cause.ACCELERATION)


def test_a_box_knocked_off_is_lost_by_a_knock() -> None:
    """It ran into something heavy."""
    world = beside_a_wall(0.002, mass=4000.0)
    world.model.mj.opt.gravity[2] = -9.81
    world.place_box(1, Pose((world.box(0).translation[0], 0.31, world.box(0).translation[2])))
    world.model.mj.body_gravcomp[world.model.box_bodies[1]] = 1.0
    world.begin(shifted(world, (0.0, 0.1, 0.0), 0.3))
    world.advance(world.now + 2.0)
    (loss,) = world.losses.lost
    assert loss.cause is Cause.KNOCK


def test_a_box_that_is_let_go_while_it_stands_is_not_lost() -> None:
    """A hold may break on a box that stands; nothing falls."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 3.0)
    x, y, _ = world.box(0).translation
    world.suction.vent(world.now)
    world.place_box(0, Pose((x, y, 0.144 + 0.15)))
    world.advance(world.now + 1.0)
    assert world.losses.lost == []


@pytest.mark.parametrize("up", [False, True])
def test_only_the_solids_of_the_present_fold_collide(*, up: bool) -> None:
    """A box in the space of the lower module's other position is touched by none."""
    world = world_of(((0.4, 0.2, 0.0), (0.05, 0.05, 0.05), 1.0))
    world.fold(up=up)
    world.model.mj.opt.gravity[2] = 0.0
    world.place_box(0, world.flange() @ Pose((0.08, 0.0, -0.17)))  # where the lowered plate is
    world.advance(0.05)
    assert bool(world.contacts.collisions) == (not up)
