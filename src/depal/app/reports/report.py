"""What a study hands to the command line."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.table import Table

from depal.app.files import Json
from depal.studies.statistics import Sample


@dataclass(frozen=True, slots=True)
class Report:
    """A result in its three forms.

    Attributes:
        fields: for `--json`.
        shown: for the terminal, in order.
        draw: for `--plot`; None where there is nothing to draw.
        holds: whether everything that must hold does.
    """

    fields: dict[str, Json]
    shown: Sequence[RenderableType]
    draw: Callable[[], Figure] | None = None
    holds: bool = True


def mean_and_std(sample: Sample) -> dict[str, Json]:
    """The fields of a mean with its population deviation."""
    return {"mean": sample.mean, "std": sample.std}


def mean_and_interval(sample: Sample) -> dict[str, Json]:
    """The fields of a mean with its 95 % interval."""
    return {"mean": sample.mean, "ci95": list(sample.ci95)}


def plus_minus(sample: Sample, digits: int = 2) -> str:
    """A mean and half its 95 % interval: "7.98 ± 0.16"."""
    low, high = sample.ci95
    return f"{sample.mean:.{digits}f} ± {(high - low) / 2:.{digits}f}"


def plain_table(title: str, *columns: str) -> Table:
    """A table whose first column is text and whose others are numbers."""
    table = Table(title=title, title_justify="left", title_style="bold")
    for index, column in enumerate(columns):
        table.add_column(column, justify="right" if index else "left")
    return table
