"""Speed and memory of each part, measured the same way everywhere."""

from depal.studies.bench.executive import bench_executive
from depal.studies.bench.figure import Figure, median_seconds
from depal.studies.bench.planning import bench_planning
from depal.studies.bench.selection import bench_selection

__all__ = ["Figure", "bench_executive", "bench_planning", "bench_selection", "median_seconds"]
