"""Speed and memory of each part, measured the same way everywhere."""

from depal.studies.bench.executive import bench_executive
from depal.studies.bench.figure import Figure, Peer, median_seconds
from depal.studies.bench.planning import bench_planning
from depal.studies.bench.selection import bench_selection
from depal.studies.bench.simulation import bench_simulation

__all__ = [
    "Figure",
    "Peer",
    "bench_executive",
    "bench_planning",
    "bench_selection",
    "bench_simulation",
    "median_seconds",
]
