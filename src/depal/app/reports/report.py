"""What a study hands to the command line."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

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


def together(*reports: Report) -> Report:
    """Several reports as one: all their fields, one below the other; drawn is the first."""
    return Report(
        {name: value for report in reports for name, value in report.fields.items()},
        [each for report in reports for each in report.shown],
        next((report.draw for report in reports if report.draw is not None), None),
        holds=all(report.holds for report in reports),
    )


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


class PlainTable(Table):
    """A table whose cells are said as they are: no mark-up in names from files."""

    def row(self, *cells: str | Text, last: bool = False) -> None:
        """Adds a row; `last` draws a line below it."""
        texts = [Text(cell) if isinstance(cell, str) else cell for cell in cells]
        self.add_row(*texts, end_section=last)


def plain_table(title: str, *columns: str) -> PlainTable:
    """A table whose first column is text and whose others are numbers."""
    table = PlainTable(title=Text(title, style="bold"), title_justify="left")
    for index, column in enumerate(columns):
        table.add_column(Text(column), justify="right" if index else "left")
    return table


def verdict(holds: bool, good: str, bad: str) -> Text:  # noqa: FBT001 - the verdict itself
    """A word in green or in red."""
    return Text(good, style="green") if holds else Text(bad, style="red")
