"""`depal learn`: the weights behind recorded orders of unloading."""

import time
from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import JsonFile, PlotFile, Seed
from depal.cli.study import check_targets, finish


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
    from depal.app.learning import learn_from, learn_report  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415

    check_targets(json_file, plot)
    start = time.perf_counter()
    with progress_bar("Learning") as progress:
        lesson = learn_from(records, seed, bootstrap, progress)
    finish(learn_report(lesson, time.perf_counter() - start), json_file, plot)
