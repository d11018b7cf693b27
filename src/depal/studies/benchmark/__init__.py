"""Every policy on every kind of pallet: actions, gap, lateness, collapse, margin, time."""

from depal.studies.benchmark.table import BenchmarkRow, benchmark
from depal.studies.benchmark.unloading import Rule

__all__ = ["BenchmarkRow", "Rule", "benchmark"]
