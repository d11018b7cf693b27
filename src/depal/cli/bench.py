"""`depal bench`: speed and memory of each part."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from depal.cli.output import JsonFile, PlotFile, Seed, Workers, console

if TYPE_CHECKING:
    from depal.app.reports import Report
    from depal.studies.bench import Figure
    from depal.studies.sweep import Progress

bench = typer.Typer(help="Speed and memory of each part.", no_args_is_help=True)


def _measure(
    part: str, json_file: Path | None, *measures: "Callable[[Progress], Sequence[Figure]]"
) -> None:
    """Measures with a progress bar for each measure, prints, writes."""
    from depal.app.files import checked_target  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports import bench_report  # noqa: PLC0415

    checked_target(json_file, "--json")
    figures: list[Figure] = []
    for measure in measures:
        with progress_bar(part.capitalize()) as progress:
            figures += measure(progress)
    _finish(bench_report(part, figures), json_file)


def _finish(report: "Report", json_file: Path | None, plot: Path | None = None) -> None:
    """Prints, draws, writes; a missed target is no error."""
    from depal.app.files import write_json  # noqa: PLC0415 - fast help
    from depal.studies.drawing import save_figure  # noqa: PLC0415

    out = console()
    for part in report.shown:
        out.print(part, highlight=False, markup=False)
    if plot is not None and report.draw is not None:
        save_figure(report.draw(), plot)
        out.print(f"figure: {plot}", highlight=False, markup=False)
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


@bench.command()
def perception(
    severity: Annotated[str, typer.Option(help="easy, normal, hard or all.")] = "all",
    scenes: Annotated[
        int, typer.Option(help="How many of each severity; 0: only --frames.", min=0)
    ] = 201,
    seed: Seed = 0,
    frames: Annotated[
        list[Path] | None,
        typer.Option(
            help="A folder with a real frame and its masks, or with such folders; again for more.",
            show_default=False,
        ),
    ] = None,
    note: Annotated[  # noqa: FBT002 - an option
        bool, typer.Option(help="Whether perception is told the delivery's note.")
    ] = True,
    workers: Workers = 1,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """What is found, named and related on scenes never used for tuning, and how fast."""
    from depal.app.files import checked_targets  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports.perception import perception_report  # noqa: PLC0415
    from depal.studies.bench.perception import (  # noqa: PLC0415
        Extent,
        bench_perception,
        severities_of,
    )
    from depal.studies.perception.eye import open_eye  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    checked_targets(json_file, plot)
    extent = Extent(severities_of(severity), scenes, seed, noted=note)
    with executor_for(workers) as executor, progress_bar("Perception") as progress:
        result = bench_perception(extent, open_eye, frames or (), executor, progress)
    _finish(perception_report(result), json_file, plot)
