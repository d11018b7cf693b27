"""A cell for the tests of the simulated world, built by hand from the default's figures."""

import math

import numpy as np

from depal.domain import (
    FRONT,
    LOWER,
    ArmGeometry,
    CameraMount,
    Capsule,
    CellLayout,
    Delivery,
    DeliveryLine,
    Gtin,
    JointLimits,
    Joints,
    PalletStand,
    Place,
    PlaceId,
    Product,
    ReaderMount,
    Robot,
    SpeedLimits,
    StackedCase,
    Storage,
    StorageKind,
    Suction,
    SuctionModule,
    Tool,
    cell_from_pallet,
)
from depal.geometry import OrientedBox, Pose
from depal.ports import Trajectory

EURO = (1.2, 0.8, 0.144)
GEOMETRY = ArmGeometry(0.35, -0.145, 0.0, 0.815, 0.85, 0.82, 0.17)
PARKED = (math.radians(-70), math.radians(-95), math.radians(110), 0.0, math.radians(60), 0.0)
REACHING = (0.0, math.radians(-60), math.radians(60), 0.0, 0.0, 0.0)


def radians(*degrees: float) -> Joints:
    """Six angles given in degrees."""
    a, b, c, d, e, f = (math.radians(value) for value in degrees)
    return (a, b, c, d, e, f)


def robot() -> Robot:
    """The KR 60 with a few capsules."""
    speed = radians(128, 102, 128, 260, 245, 322)
    rise = (0.45, 0.45, 0.40, 0.30, 0.30, 0.25)
    a, b, c, d, e, f = (rate / time for rate, time in zip(speed, rise, strict=True))
    limits = JointLimits(
        lower=radians(-185, -135, -120, -350, -119, -350),
        upper=radians(185, 35, 158, 350, 119, 350),
        speed=speed,
        acceleration=(a, b, c, d, e, f),
    )
    shapes = (
        Capsule(0, (0, 0, 0.25), (0, 0, 0.45), 0.25),
        Capsule(1, (0.05, 0, 0.62), (0.3, 0, 0.75), 0.22),
        Capsule(2, (0, 0, 0), (0.85, 0, 0), 0.15),
        Capsule(3, (0, 0, 0), (0, 0, 0.145), 0.17),
        Capsule(4, (0, 0, 0), (0.65, 0, 0), 0.11),
        Capsule(5, (-0.03, 0, 0), (0.03, 0, 0), 0.09),
        Capsule(6, (0.05, 0, 0), (0.1, 0, 0), 0.07),
    )
    masses = (120.0, 150.0, 120.0, 130.0, 60.0, 25.0, 10.0)
    return Robot("kr60", GEOMETRY, limits, 60.0, masses, shapes, PARKED)


def tool() -> Tool:
    """The L-shaped tool."""
    cups = tuple((y, z) for z in (-0.05, 0.05) for y in (-0.1, 0.0, 0.1))
    down = Pose((0.1, 0.0, -0.2), ((0, 0, 1), (0, 1, 0), (-1, 0, 0)))
    front = SuctionModule(FRONT, Pose((0.2, 0.0, 0.0)), (0.3, 0.2), cups)
    lower = SuctionModule(LOWER, down, (0.3, 0.2), cups)
    folded = SuctionModule(LOWER, Pose((0.2, 0.0, -0.2)), (0.3, 0.2), cups)
    plate = OrientedBox(Pose((0.15, 0, 0)), (0.06, 0.3, 0.2))
    neck = OrientedBox(Pose((0.06, 0, 0)), (0.12, 0.14, 0.14))
    under = OrientedBox(Pose((0.1, 0, -0.15)), (0.16, 0.3, 0.06))
    swung = OrientedBox(Pose((0.15, 0, -0.2)), (0.06, 0.3, 0.2))
    suction = Suction(0.03, 85.0 / (math.pi * 0.03**2), 0.5, 0.01, 1e4, 0.25, 0.2)
    return Tool(
        mass=18.0,
        centre_of_mass=(0.1, 0.0, -0.05),
        suction=suction,
        modules=(front, lower),
        folded_lower=folded,
        shapes=(plate, neck, under),
        folded_shapes=(plate, neck, swung),
        safety=2.0,
        fold_time=0.6,
    )


def trolley(name: str, x: float, side: float) -> Storage:
    """A trolley with two levels whose front is at y = 1.7 on a side (1 left, -1 right)."""
    inwards = Pose.from_yaw((x, 1.7 * side, 0.0), math.pi / 2 * side)
    width, depth, height = 0.7, 0.6, 1.5
    wall = 0.02
    panels = [
        OrientedBox.upright((depth / 2, y, height / 2), (depth, wall, height))
        for y in (-width / 2 + wall / 2, width / 2 - wall / 2)
    ]
    panels.append(OrientedBox.upright((depth - wall / 2, 0, height / 2), (wall, width, height)))
    floors = (0.3, 0.9)
    panels += [
        OrientedBox.upright((depth / 2, 0, z - wall / 2), (depth, width, wall)) for z in floors
    ]
    places = tuple(
        Place(
            PlaceId(f"{name}/level_{number}"),
            inwards @ Pose((0.0, 0.0, z)),
            (width - 2 * wall, 0.55),
            depth - wall,
        )
        for number, z in enumerate(floors, start=1)
    )
    size = (width, depth, height)
    return Storage(name, StorageKind.TROLLEY, inwards, size, tuple(panels), places)


def layout() -> CellLayout:
    """A cell with two trolleys."""
    right, down, forward = (0, -1, 0), (0, 0, -1), (1, 0, 0)
    columns = tuple(zip(right, down, forward, strict=True))
    eye = Pose((0.2, -0.5, 1.3), columns)
    camera = CameraMount("mast", eye, (1920, 1080), (1280, 720), 1.6)
    reader = ReaderMount(Pose((0.8, 1.2, 0.8), columns), 0.4, (0.3, 0.2), (1280, 960))
    return CellLayout(
        name="test",
        floor=((-2.5, -2.5), (2.5, 2.5)),
        robot=robot(),
        tool=tool(),
        pallet=PalletStand(cell_from_pallet(EURO), EURO),
        storages=(trolley("trolley_1", 0.0, 1.0), trolley("trolley_2", 0.0, -1.0)),
        aside="trolley_2",
        cameras=(camera,),
        reader=reader,
        speeds=SpeedLimits(2.0, 0.25, 0.03),
    )


def delivery(
    *cases: tuple[tuple[float, float, float], tuple[float, float, float], float],
) -> Delivery:
    """A delivery of (corner, size, mass) on the pallet, each of its own product."""
    lines = tuple(
        DeliveryLine(Product(Gtin(f"{10000000000000 + k}"), f"case {k}", size, mass), 1)
        for k, (_, size, mass) in enumerate(cases)
    )
    stack = tuple(
        StackedCase(line.product.gtin, corner, size)
        for line, (corner, size, _) in zip(lines, cases, strict=True)
    )
    return Delivery("test", EURO, lines, stack)


def point_to_point(start: Joints, end: Joints, seconds: float) -> Trajectory:
    """A smooth joint motion of the fifth degree from rest to rest."""
    u = np.linspace(0.0, 1.0, max(int(seconds / 0.01), 2) + 1)
    share = 10 * u**3 - 15 * u**4 + 6 * u**5
    rate = 30 * u**2 * (1 - u) ** 2 / seconds
    first, way = np.array(start), np.array(end) - np.array(start)
    return Trajectory(u * seconds, first + np.outer(share, way), np.outer(rate, way))
