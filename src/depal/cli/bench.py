"""`depal bench`: speed and memory of each part."""

import typer

from depal.cli.output import JsonFile, Seed, console

bench = typer.Typer(help="Speed and memory of each part.", no_args_is_help=True)


@bench.command()
def selection(seed: Seed = 0, json_file: JsonFile = None) -> None:
    """The graph, one selection, its update, and case study 1; networkx beside it."""
    from depal.app.files import checked_target, write_json  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports import bench_report  # noqa: PLC0415
    from depal.studies.bench import bench_selection  # noqa: PLC0415

    checked_target(json_file, "--json")
    with progress_bar("Selection") as progress:
        report = bench_report("selection", bench_selection(seed, progress))
    for part in report.shown:
        console().print(part, highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)


@bench.command()
def executive(json_file: JsonFile = None) -> None:
    """Events, allocation, commands, journal, restart, a simulated day; with peers beside it."""
    from depal.app.files import checked_target, write_json  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports import bench_report  # noqa: PLC0415
    from depal.studies.bench import bench_executive  # noqa: PLC0415

    checked_target(json_file, "--json")
    with progress_bar("Executive") as progress:
        report = bench_report("executive", bench_executive(progress))
    for part in report.shown:
        console().print(part, highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)
