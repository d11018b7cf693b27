"""Kinematics, collision checks, whole motions, places: how fast, how sure, how short, how full."""

import math
import time
from collections.abc import Callable, Iterable
from itertools import islice
from statistics import median

import numpy as np
import numpy.typing as npt

from depal.cell.files import shipped_cell
from depal.domain import CellLayout
from depal.geometry import OrientedBox, Pose, kernel
from depal.logistics import read_delivery, shipped_deliveries
from depal.motion.collision import STEP, Body, Checker, Hand, Margins, Scene, fixed_solids
from depal.motion.collision.checking import Case, first_hit
from depal.motion.kinematics import Kinematics, keep_within, rows_of, solve_branches
from depal.studies.bench.figure import Figure, Peer, median_seconds
from depal.studies.bench.placing import placing_figures
from depal.studies.bench.planning_peer import Query, ompl_ways
from depal.studies.bench.planning_referee import Referee
from depal.studies.bench.planning_work import Emptying, Motion
from depal.studies.real import perceived_stack
from depal.studies.sweep import Progress, no_progress

Floats = npt.NDArray[np.float64]

CONFIGURATIONS = 10_000
"""So many are compared with MuJoCo."""

DELIVERIES = ("dev-018", "dev-000", "dev-030")
"""Shipped ones whose boxes are picked and put away."""

_TOUCHING = Margins(0.0, 0.0, 0.0, 0.0, 0.0)
_HELD = OrientedBox(Pose((0.37, 0.02, -0.03)), (0.34, 0.27, 0.22))
_HANGING = OrientedBox(Pose((0.12, -0.01, -0.34)), (0.30, 0.40, 0.28))
_VARIANTS = ((None, False), (None, True), (_HELD, False), (_HELD, True), (_HANGING, False))
_DEEP = 1e-6
_NO_WAY = "no free way"
_PEER_QUERIES, _PEER_LIMIT = 40, 1.0


def bench_planning(
    seed: int = 0, progress: Progress = no_progress, *, deliveries: int = len(DELIVERIES)
) -> list[Figure]:
    """Measures every figure of planning.

    Args:
        seed: of random configurations and of the planner.
        progress: told how far it is.
        deliveries: so many of `DELIVERIES` are emptied.

    Returns:
        The figures.
    """
    layout = shipped_cell("default")
    measures: list[Callable[[], list[Figure]]] = [
        lambda: kinematics_figures(Kinematics(layout.robot), seed),
        lambda: collision_figures(layout, seed),
        lambda: motion_figures(layout, seed, deliveries),
        placing_figures,
    ]
    figures: list[Figure] = []
    for done, measure in enumerate(measures):
        progress(done, len(measures))
        figures += measure()
    progress(len(measures), len(measures))
    return figures


def kinematics_figures(arm: Kinematics, seed: int, count: int = 20_000) -> list[Figure]:
    """All branches of random poses: time and error."""
    rng = np.random.default_rng(seed)
    postures = rng.uniform(arm.lower, arm.upper, (count, 6))
    poses = np.array([arm.frames(q)[6] for q in postures])
    near = np.zeros(6)
    seconds = median_seconds(
        lambda: solve_all(poses, near, arm.dims, arm.lower, arm.upper), repetitions=5
    )
    worst = 0.0
    for q in postures[:2000]:
        pose = arm.flange(q)
        for solution in arm.solve(pose, q):
            off = arm.frames(solution)[6, :, 3] - rows_of(pose)[:, 3]
            worst = max(worst, float(np.abs(off).max()))
    return [
        Figure("inverse kinematics, all branches", seconds / count * 1e6, "us", 5.0, "lower", 5),
        Figure("inverse kinematics, worst error", worst, "m", 1e-9, "lower", 2000),
    ]


@kernel
def solve_all(poses: Floats, near: Floats, dims: Floats, lower: Floats, upper: Floats) -> int:
    """How many configurations reach some poses (n, 3, 4)."""
    branches, kept, found = np.empty((8, 6)), np.empty((8, 6)), 0
    for k in range(len(poses)):
        count = solve_branches(poses[k], dims, near[3], branches)
        found += keep_within(branches, count, near, lower, upper, kept)
    return found


@kernel
def count_free(case: Case, postures: Floats) -> int:
    """How many of some configurations (n, 6) touch nothing."""
    free = 0
    for k in range(len(postures)):
        if first_hit(case, postures[k])[0] < 0:
            free += 1
    return free


def collision_figures(layout: CellLayout, seed: int) -> list[Figure]:
    """Checks a second among a real stack, and what MuJoCo finds that they miss."""
    delivery = min(shipped_deliveries(), key=lambda one: abs(len(one.boxes) - 40))
    cases = [(str(box.id), box.shape) for box in perceived_stack(delivery)]
    solids = fixed_solids(layout)
    scene, boxes = Scene.of(solids, cases), [box for _, box in solids + cases]
    body = Body.of(layout)
    postures = random_postures(body.kinematics, CONFIGURATIONS, seed)
    holding = Checker(body, Hand.of(layout.tool, held=_HELD), scene, Margins())
    seconds = median_seconds(lambda: count_free(holding.case, postures), repetitions=5)
    referee = Referee(layout, boxes, _HELD)
    begin = time.perf_counter()
    for q in postures[:2000]:
        referee.nearest(q)
    theirs = 2000 / (time.perf_counter() - begin)
    missed = 0
    for variant, (held, folded) in enumerate(_VARIANTS):
        part = postures[variant :: len(_VARIANTS)]
        hand = Hand.of(layout.tool, folded=folded, held=held)
        checker = Checker(body, hand, scene, _TOUCHING)
        referee = Referee(layout, boxes, held, folded=folded)
        missed += sum(referee.nearest(q) < -_DEEP and checker.free(q) for q in part)
    return [
        Figure(
            f"collision checks among {len(cases)} boxes, one held",
            CONFIGURATIONS / seconds,
            "1/s",
            150_000.0,
            "higher",
            5,
            (Peer("MuJoCo", theirs),),
        ),
        Figure("collisions missed", float(missed), "", 0.0, "lower", CONFIGURATIONS),
    ]


def random_postures(arm: Kinematics, count: int, seed: int) -> Floats:
    """Half of them anywhere, half with the flange where it works: before storages and pallet."""
    rng = np.random.default_rng(seed)
    anywhere = rng.uniform(arm.lower, arm.upper, (count // 2, 6))
    near: list[Floats] = []
    while len(near) < count - count // 2:
        heading, pitch = rng.uniform(-math.pi, math.pi), rng.normal(0.0, 0.3)
        yaw, roll = heading + rng.normal(0.0, 0.4), math.pi / 2 * rng.integers(4)
        out, up = rng.uniform(1.0, 1.7), rng.uniform(0.2, 1.9)
        at = (out * math.cos(heading), out * math.sin(heading), up)
        near += list(arm.solve(Pose.from_arrays(at, turned(yaw, pitch, roll))))
    return np.concatenate((anywhere, np.array(near[: count - count // 2])))


def turned(yaw: float, pitch: float, roll: float) -> Floats:
    """A turn about z, then the new -y, then the new x, (3, 3) [rad]."""
    (cy, sy), (cp, sp), (cr, sr) = ((math.cos(a), math.sin(a)) for a in (yaw, pitch, roll))
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    about_y = np.array([[cp, 0.0, -sp], [0.0, 1.0, 0.0], [sp, 0.0, cp]])
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    turn: Floats = about_z @ about_y @ about_x
    return turn


def motion_figures(layout: CellLayout, seed: int, count: int) -> list[Figure]:
    """Every pick and every put of real deliveries, planned one after the other."""
    chosen = [read_delivery(name) for name in DELIVERIES[:count]]
    for _ in islice(Emptying(layout, chosen[0], seed).motions(), 8):  # compiles
        pass
    motions: list[Motion] = []
    for delivery in chosen:
        motions += Emptying(layout, delivery, seed).motions()
    milliseconds = np.array([1e3 * motion.seconds for motion in motions])
    lost = sum(_NO_WAY in motion.reason for motion in motions)
    speed = np.array(layout.robot.limits.speed)
    paths = [motion.part.path for motion in motions if motion.part is not None]
    ratios = [ratio for path in paths if (ratio := over_bound(path, speed)) is not None]
    peers, ratio_peers = ompl_figures(layout, motions, speed)
    found = 100.0 * (1 - lost / len(motions))
    n = len(motions)
    return [
        Figure("planning a motion", float(np.median(milliseconds)), "ms", 30.0, "lower", n, peers),
        Figure(
            "planning a motion, 95th percentile",
            float(np.percentile(milliseconds, 95)),
            "ms",
            200.0,
            "lower",
            n,
        ),
        Figure("motions found of those that can be reached", found, "%", 99.5, "higher", n),
        Figure(
            "path over the straight joint line, in time at full speed",
            median(ratios),
            "",
            1.4,
            "lower",
            len(ratios),
            ratio_peers,
        ),
    ]


def over_bound(path: Floats, speed: Floats) -> float | None:
    """The time of a path at full speed over that of the straight joint line; None for no move."""
    bound = float((np.abs(path[-1] - path[0]) / speed).max())
    return length_of(path, speed) / bound if bound > _DEEP else None


def length_of(path: Floats, speed: Floats) -> float:
    """The time of a path at full speed [s]."""
    return float((np.abs(np.diff(path, axis=0)) / speed).max(axis=1).sum())


def ompl_figures(
    layout: CellLayout, motions: Iterable[Motion], speed: Floats
) -> tuple[tuple[Peer, ...], tuple[Peer, ...]]:
    """OMPL's time [ms] and its paths' ratio over some of the same ways through free space."""
    arm = Kinematics(layout.robot)
    queries = [
        Query(
            motion.checker.case,
            STEP,
            speed,
            arm.lower,
            arm.upper,
            motion.part.path[0],
            motion.part.path[-1],
        )
        for motion in motions
        if motion.part is not None and over_bound(motion.part.path, speed) is not None
    ][:_PEER_QUERIES]
    ways = ompl_ways(queries, _PEER_LIMIT)
    if ways is None:
        return (), ()
    bounds = [length_of(np.stack((query.start, query.goal)), speed) for query in queries]
    ratios = [length / bound for (_, length), bound in zip(ways, bounds, strict=True)]
    return (
        (Peer("OMPL, free space alone", 1e3 * median(seconds for seconds, _ in ways)),),
        (Peer("OMPL", median(ratios)),),
    )
