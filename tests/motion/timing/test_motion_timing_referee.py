"""toppra times the same paths: a referee who shares no line with the sweep."""

import itertools
import warnings
from collections.abc import Callable

import numpy as np
import pytest
from timed_motions import ACCELERATION, KINEMATICS, ROBOT, SPEED, Floats, carried, corners

from depal.motion.grasping import Holding, cone_rows
from depal.motion.timing import Leg, Path, smooth, time_path

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import toppra
    from toppra import constraint
    from toppra.algorithm import TOPPRA
    from toppra.interpolator import AbstractGeometricPath

toppra.setup_logging("ERROR")

SCHEME = constraint.DiscretizationType.Interpolation


class _Pieces(AbstractGeometricPath):
    """A path of ours as toppra wants it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.starts = np.concatenate(((0.0,), np.cumsum(path.lengths)))

    @property
    def dof(self) -> int:
        return 6

    @property
    def path_interval(self) -> Floats:
        return self.starts[[0, -1]]

    @property
    def waypoints(self) -> None:
        return None

    def __call__(self, at: Floats, order: int = 0) -> Floats:
        x = np.atleast_1d(np.asarray(at, dtype=float))
        k = np.clip(np.searchsorted(self.starts, x, side="right") - 1, 0, len(self.starts) - 2)
        u, c = (x - self.starts[k])[:, None], self.path.pieces[k]
        if order == 0:
            out = c[:, 0] + u * (c[:, 1] + u * (c[:, 2] + u * c[:, 3]))
        elif order == 1:
            out = c[:, 1] + u * (2 * c[:, 2] + 3 * u * c[:, 3])
        else:
            out = 2 * c[:, 2] + 6 * u * c[:, 3]
        result: Floats = out[0] if np.ndim(at) == 0 else out
        return result


def referee(path: Path, *extra: object, points: int = 60) -> float:
    """The duration that toppra finds [s]."""
    starts = np.concatenate(((0.0,), np.cumsum(path.lengths)))
    grid = np.concatenate([np.linspace(a, b, points) for a, b in itertools.pairwise(starts)])
    grid = grid[np.concatenate(((True,), np.diff(grid) > 1e-9))]
    limits = [
        constraint.JointVelocityConstraint(np.stack((-SPEED, SPEED), axis=1)),
        constraint.JointAccelerationConstraint(
            np.stack((-ACCELERATION, ACCELERATION), axis=1), discretization_scheme=SCHEME
        ),
        *extra,
    ]
    sweep = TOPPRA(limits, _Pieces(path), gridpoints=grid, solver_wrapper="seidel")
    rates = sweep.compute_parameterization(0, 0)[1]
    return float(np.sum(2 * np.diff(grid) / (rates[:-1] + rates[1:])))


def cups(holding: Holding) -> Callable[[Floats, Floats, Floats], Floats]:
    """Force and moment at the cups for a state of the axes, by differences of Jacobians."""
    h = 1e-6

    def wrench(q: Floats, rate: Floats, acceleration: Floats) -> Floats:
        jacobian = KINEMATICS.jacobian(q)
        drift = (KINEMATICS.jacobian(q + h * rate) - KINEMATICS.jacobian(q - h * rate)) / (2 * h)
        moved = jacobian @ acceleration + drift @ rate
        spin = (jacobian @ rate)[3:]
        turn = KINEMATICS.frames(q)[6][:, :3]
        a, alpha, omega = turn.T @ moved[:3], turn.T @ moved[3:], turn.T @ spin
        up = turn.T @ np.array([0.0, 0.0, 9.81])
        centre = a + np.cross(alpha, holding.centre)
        centre = centre + np.cross(omega, np.cross(omega, holding.centre)) + up
        force = -holding.mass * centre
        turning = holding.inertia @ alpha + np.cross(omega, holding.inertia @ omega)
        moment = np.cross(holding.centre - holding.middle, force) - turning
        into = holding.flange_from_face.T
        out: Floats = np.concatenate((into @ force, into @ moment))
        return out

    return wrench


@pytest.mark.parametrize("seed", range(12))
def test_the_sweep_is_as_fast_as_toppra_over_wide_corners(seed: int) -> None:
    """Within half a percent."""
    legs = [Leg(corners(seed, most=4))]
    path = smooth(legs, ROBOT, lambda _: True)
    trajectory = time_path(legs, ROBOT, clear=lambda _: True)
    assert path is not None
    assert trajectory is not None
    if not path.stops[1:-1].any():
        assert trajectory.duration == pytest.approx(referee(path), rel=0.005)


@pytest.mark.parametrize("seed", range(12, 20))
def test_over_tight_corners_it_is_up_to_5_percent_faster(seed: int) -> None:
    """There toppra sees the curvature behind a piece's end in the piece before, too."""
    legs = [Leg(corners(seed, most=4))]
    path = smooth(legs, ROBOT)
    trajectory = time_path(legs, ROBOT)
    assert path is not None
    assert trajectory is not None
    if not path.stops[1:-1].any():
        assert 0.95 < trajectory.duration / referee(path) < 1.005


def test_with_a_held_box_the_sweep_is_as_fast_as_toppra() -> None:
    """The rows of the suction, with the wrench by another way."""
    compared = slower = 0
    for seed in range(200):
        case = carried(seed, (7.0, 11.0))
        if case is None:
            continue
        leg, holding = case
        leg = Leg(leg.points)
        trajectory = time_path([leg], ROBOT, held=holding)
        path = smooth([leg], ROBOT)
        free = time_path([leg], ROBOT)
        if trajectory is None or path is None or free is None:
            continue
        rows = cone_rows(holding)
        suction = constraint.SecondOrderConstraint(
            cups(holding),
            lambda _, rows=rows: rows,
            lambda _, rows=rows: np.ones(len(rows)),
            6,
            discretization_scheme=SCHEME,
        )
        duration = referee(path, suction)
        assert trajectory.duration == pytest.approx(duration, rel=0.01)
        compared += 1
        slower += trajectory.duration > 1.05 * free.duration
        if compared == 12:
            break
    assert slower > 3
