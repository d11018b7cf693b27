"""What `depal bench simulation` says of whole runs: a delivery by truth, by camera; case 2."""

import math
from collections.abc import Callable
from dataclasses import replace
from statistics import median

import numpy as np

from depal.app.run.case2 import NAME as CASE2
from depal.app.run.job import NONE, prepared, run_job
from depal.app.run.summary import Outcome
from depal.app.run.values import CAMERA, Job, Options
from depal.domain import BoxId
from depal.errors import MissingPartError
from depal.logistics.store import random_requests
from depal.studies import paper
from depal.studies.bench import Figure, Peer
from depal.studies.bench.memory import peak_megabytes
from depal.studies.case2 import REQUESTED
from depal.studies.sweep import Progress, no_progress

DELIVERY = "dev-000"
"""Real, with thirty boxes."""

REQUESTS = 3

PEAK = 1500.0
"""The most memory that a run may take [MB]."""


def run_figures(seed: int = 0, progress: Progress = no_progress) -> list[Figure]:
    """Runs, and measures them.

    Args:
        seed: of every random number.
        progress: told how far it is.
    """
    delivery = prepared(Options(delivery=DELIVERY, seed=seed))
    asked = random_requests(delivery.delivery, REQUESTS, seed)
    job = replace(delivery, requests=asked)
    case2 = Options(delivery=CASE2, w=paper.CASE_2_WEIGHT, seed=seed)
    jobs: list[Callable[[], Job]] = [
        lambda: job,
        lambda: job,
        lambda: prepared(replace(case2, requests=NONE)),
        lambda: prepared(case2),
        lambda: prepared(replace(case2, speed=paper.CASE_2_SPEED)),
    ]
    outcomes = []
    for done, prepare in enumerate(jobs):
        progress(done, len(jobs) + 1)
        outcomes.append(run_job(prepare()))
    progress(len(jobs), len(jobs) + 1)
    first, second, *cases = outcomes
    seen = _by_camera(job)
    progress(len(jobs) + 1, len(jobs) + 1)
    return [
        *delivery_figures(first, second),
        *([] if seen is None else camera_figures(second, seen)),
        *case2_figures(*cases),
        _memory(),
    ]


def _by_camera(job: Job) -> Outcome | None:
    """The same run, seen by the cell's cameras; None where there is no perception."""
    try:
        return run_job(replace(job, perception=CAMERA))
    except MissingPartError:
        return None


def camera_figures(truth: Outcome, camera: Outcome) -> list[Figure]:
    """Of a run that sees with its cameras, beside the same run that knows the truth."""
    name, boxes = f"{camera.delivery} by camera", camera.boxes
    counts = {
        "lost": camera.lost,
        "collisions": len(camera.referee.collisions),
        "not where the books say": len(camera.disagreements),
    }
    rate = 100 * camera.boxes_per_hour / truth.boxes_per_hour if truth.boxes_per_hour else math.nan
    return [
        Figure(f"{name}: boxes stored", 100 * camera.stored / boxes, "%", 97.0, "higher", boxes),
        *(
            Figure(f"{name}: {what}", float(count), "", 0.0, "lower", boxes)
            for what, count in counts.items()
        ),
        Figure(f"{name}: rate, of the truth's", rate, "%", 85.0, "higher", 1),
        Figure(
            f"{name}: real time, of the truth's",
            camera.wall_seconds / truth.wall_seconds,
            "x",
            2.5,
            "lower",
            1,
        ),
    ]


def delivery_figures(first: Outcome, second: Outcome) -> list[Figure]:
    """Of the same run twice; times are the second's, for the first may have compiled."""
    name, boxes, plans = first.delivery, first.boxes, second.plan_seconds
    counts = {
        "lost": first.lost,
        "collisions": len(first.referee.collisions),
        "not where the books say": len(first.disagreements),
        "holds that gave way": len(first.referee.lost),
        "event logs that differ for the same seed": int(
            first.events_sha256 != second.events_sha256
        ),
    }
    milliseconds = 1e3 * np.array(plans) if plans else np.array([np.nan])
    stored = 100 * first.stored / boxes
    return [
        Figure(f"{name}: boxes stored", stored, "%", 99.0, "higher", boxes),
        *(
            Figure(f"{name}: {what}", float(count), "", 0.0, "lower", boxes)
            for what, count in counts.items()
        ),
        Figure(f"{name}: rate", first.boxes_per_hour, "boxes/h", 400.0, "higher", boxes),
        Figure(f"{name}: real time", second.wall_seconds, "s", 90.0, "lower", 1),
        Figure(f"{name}: planning a motion", median(milliseconds), "ms", 30.0, "lower", len(plans)),
        Figure(
            f"{name}: planning a motion, 95th percentile",
            float(np.percentile(milliseconds, 95)),
            "ms",
            200.0,
            "lower",
            len(plans),
        ),
    ]


def case2_figures(without: Outcome, requested: Outcome, slow: Outcome) -> list[Figure]:
    """Of the paper's ten boxes: the rank of the requested one, and the times at its speed."""
    speed = f"{100 * slow.speed:g} % of the speed"
    working = slow.sim_seconds - slow.waiting_seconds
    gone = [departure.at for departure in slow.departures if departure.box == REQUESTED]
    return [
        Figure(
            "case 2: b1's rank without the request",
            rank_of(BoxId(REQUESTED), without),
            "",
            paper.CASE_2_RANK_WITHOUT,
            "higher",
            1,
            (Peer("paper", paper.CASE_2_RANK_WITHOUT),),
        ),
        Figure(
            "case 2: b1's rank with the request",
            rank_of(BoxId(REQUESTED), requested),
            "",
            paper.CASE_2_RANK_WITH,
            "lower",
            1,
            (Peer("paper", paper.CASE_2_RANK_WITH),),
        ),
        Figure(
            f"case 2: a box at {speed}",
            working / slow.boxes,
            "s",
            math.nan,
            "lower",
            slow.boxes,
            (Peer("paper", paper.CASE_2_SECONDS),),
        ),
        Figure(
            f"case 2: until b1 leaves the pallet at {speed}",
            gone[0] if gone else math.nan,
            "s",
            math.nan,
            "lower",
            1,
            (Peer("paper, until it is stored", paper.CASE_2_SECONDS_TO_REQUESTED),),
        ),
    ]


def rank_of(box: BoxId, outcome: Outcome) -> float:
    """Which box it is in the sequence, from 1 on; nan where it did not leave."""
    order = [departure.box for departure in outcome.departures]
    return float(order.index(box) + 1) if box in order else math.nan


def _memory() -> Figure:
    name = "peak memory of the process after all runs"
    return Figure(name, peak_megabytes(), "MB", PEAK, "lower", 1)
