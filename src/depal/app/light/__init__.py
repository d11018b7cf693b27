"""The real controller over a light world: runs by the thousand, with controllers that end."""

from depal.app.light.cuts import Cut, Kind, Moment
from depal.app.light.referee import Count
from depal.app.light.report import storm_report
from depal.app.light.run import LightJob, LightOutcome, run_light
from depal.app.light.storm import Storm, Stormed, storm

__all__ = [
    "Count",
    "Cut",
    "Kind",
    "LightJob",
    "LightOutcome",
    "Moment",
    "Storm",
    "Stormed",
    "run_light",
    "storm",
    "storm_report",
]
