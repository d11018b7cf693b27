"""`depal bench`: speed and memory of each part."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from depal.cli.output import JsonFile, Seed, console

if TYPE_CHECKING:
    from depal.studies.bench import Figure
    from depal.studies.sweep import Progress

bench = typer.Typer(help="Speed and memory of each part.", no_args_is_help=True)


def _measure(
    part: str, json_file: Path | None, *measures: "Callable[[Progress], Sequence[Figure]]"
) -> None:
    """Measures with a progress bar for each measure, prints, writes."""
    from depal.app.files import checked_target, write_json  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports import bench_report  # noqa: PLC0415

    checked_target(json_file, "--json")
    figures: list[Figure] = []
    for measure in measures:
        with progress_bar(part.capitalize()) as progress:
            figures += measure(progress)
    report = bench_report(part, figures)
    for table in report.shown:
        console().print(table, highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)


@bench.command()
def selection(seed: Seed = 0, json_file: JsonFile = None) -> None:
    """The graph, one selection, its update, and case study 1; networkx beside it."""
    from depal.studies.bench import bench_selection  # noqa: PLC0415 - fast help

    _measure("selection", json_file, lambda progress: bench_selection(seed, progress))


@bench.command()
def executive(json_file: JsonFile = None) -> None:
    """Events, allocation, commands, journal, restart, a simulated day; with peers beside it."""
    from depal.studies.bench import bench_executive  # noqa: PLC0415 - fast help

    _measure("executive", json_file, bench_executive)


@bench.command()
def planning(seed: Seed = 0, json_file: JsonFile = None) -> None:
    """Kinematics, collision checks, motions, places; MuJoCo and OMPL beside them."""
    from depal.studies.bench import bench_planning  # noqa: PLC0415 - fast help

    _measure("planning", json_file, lambda progress: bench_planning(seed, progress))


@bench.command()
def simulation(
    seed: Seed = 0,
    runs: Annotated[  # noqa: FBT002 - an option
        bool, typer.Option(help="Whole runs too: a 30-box delivery twice, the paper's ten boxes.")
    ] = True,
    json_file: JsonFile = None,
) -> None:
    """Physics, servos, suction, memory; then whole runs: stored, lost, rate, wall time."""
    from depal.app.run_figures import run_figures  # noqa: PLC0415 - fast help
    from depal.studies.bench import bench_simulation  # noqa: PLC0415

    measures: list[Callable[[Progress], Sequence[Figure]]] = [bench_simulation]
    if runs:
        measures.append(lambda progress: run_figures(seed, progress))
    _measure("simulation", json_file, *measures)
