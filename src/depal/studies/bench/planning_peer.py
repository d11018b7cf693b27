"""OMPL's RRT-Connect at the same ways through free space, with the same checks.

The planner of the paper is the reference, not the planner of the cell: OMPL seeds its random
numbers once a process and stops by the clock or by a callback, so the same call twice gives two
paths, and a run could not be repeated to the byte.
"""

import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from multiprocessing import get_context

import numpy as np
import numpy.typing as npt

from depal.motion.collision.checking import Case, first_hit
from depal.motion.collision.edges import edge_is_free

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Query:
    """One way through free space that is wanted.

    Attributes:
        case: what must not be touched.
        step: of the checks along edges [m].
        speed: (6,) of the axes [rad/s]; distances are times.
        lower: (6,) [rad].
        upper: (6,) [rad].
        start: (6,) [rad].
        goal: (6,) [rad].
    """

    case: Case
    step: float
    speed: Floats
    lower: Floats
    upper: Floats
    start: Floats
    goal: Floats


def ompl_ways(queries: list[Query], limit: float) -> list[tuple[float, float]] | None:
    """OMPL's RRT-Connect with its own simplification, in a process of its own.

    Args:
        queries: what is wanted.
        limit: for each [s].

    Returns:
        Per query the time that it took [s] and the time of the path at full speed [s], infinite
        where none was found; None where OMPL is not installed.
    """
    if find_spec("ompl") is None:
        return None
    with ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=_silence) as executor:
        return executor.submit(_solve, queries, limit).result()


def _silence() -> None:
    """OMPL's bindings talk at the end of a process about what they have not freed."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def _solve(queries: list[Query], limit: float) -> list[tuple[float, float]]:
    base, geometric = import_module("ompl.base"), import_module("ompl.geometric")
    util = import_module("ompl.util")
    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(1)
    for query in queries[:1]:
        edge_is_free(query.case, query.start, query.start, query.step)
    return [_way(query, limit, base, geometric) for query in queries]


def _way(query: Query, limit: float, base: object, geometric: object) -> tuple[float, float]:
    space = base.RealVectorStateSpace(6)  # type: ignore[attr-defined]
    bounds = base.RealVectorBounds(6)  # type: ignore[attr-defined]
    for axis in range(6):  # in seconds at full speed
        bounds.setLow(axis, float(query.lower[axis] / query.speed[axis]))
        bounds.setHigh(axis, float(query.upper[axis] / query.speed[axis]))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)  # type: ignore[attr-defined]
    information = setup.getSpaceInformation()

    def joints(state: object) -> Floats:
        return np.array([state[axis] for axis in range(6)]) * query.speed  # type: ignore[index]

    setup.setStateValidityChecker(lambda state: bool(first_hit(query.case, joints(state))[0] < 0))
    moved = float((np.abs(query.upper - query.lower) * reaches(query.case)).sum())
    information.setStateValidityCheckingResolution(query.step / moved)
    ends = []
    for q in (query.start, query.goal):
        state = space.allocState()
        for axis in range(6):
            state[axis] = float(q[axis] / query.speed[axis])
        ends.append(state)
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(geometric.RRTConnect(information))  # type: ignore[attr-defined]
    begin = time.perf_counter()
    solved = setup.solve(limit)
    if not solved or not setup.haveExactSolutionPath():
        return time.perf_counter() - begin, float("inf")
    setup.simplifySolution()
    seconds = time.perf_counter() - begin
    path = setup.getSolutionPath()
    corners = np.array([joints(path.getState(k)) for k in range(path.getStateCount())])
    return seconds, float((np.abs(np.diff(corners, axis=0)) / query.speed).max(axis=1).sum())


def reaches(case: Case) -> Floats:
    """How far from each axis the furthest thing that it moves can ever be, (6,) [m]."""
    a1, a2, _, _, c2, c3, c4 = case.dims.tolist()
    furthest = np.maximum(np.abs(case.hand.low), np.abs(case.hand.high))
    tip = float(np.linalg.norm(furthest, axis=1).max())
    elbow = float(np.hypot(c3, a2)) + c4 + tip
    return np.array([abs(a1) + c2 + elbow, c2 + elbow, elbow, c4 + tip, c4 + tip, tip])
