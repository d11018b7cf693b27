"""`depal learn`: the weights behind recorded orders of unloading."""

import time
from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import JsonFile, PlotFile, Seed, console


def learn(
    records: Annotated[
        list[Path],
        typer.Argument(
            help="Folders of `depal run --record`, folders of those, or .jsonl files of orders."
        ),
    ],
    bootstrap: Annotated[
        int, typer.Option(help="Resamples of pallets for the intervals; 0: by information.", min=0)
    ] = 0,
    seed: Seed = 0,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Learn w and the weights of h from the orders in which people or policies unloaded."""
    from depal.app.files import checked_targets, write_json  # noqa: PLC0415 - fast help
    from depal.app.learning import learn_from, learn_report  # noqa: PLC0415
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.studies.drawing import save_figure  # noqa: PLC0415

    checked_targets(json_file, plot)
    start = time.perf_counter()
    with progress_bar("Learning") as progress:
        lesson = learn_from(records, seed, bootstrap, progress)
    report = learn_report(lesson, time.perf_counter() - start)
    out = console()
    for part in report.shown:
        out.print(part, highlight=False, markup=False)
    if plot is not None and report.draw is not None:
        save_figure(report.draw(), plot)
        out.print(f"figure: {plot}", highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)
    if not report.holds:
        raise typer.Exit(1)
