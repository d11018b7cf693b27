"""`depal study`: the paper's case studies."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from depal.cli.output import (
    Dask,
    JsonFile,
    Keep,
    Perception,
    PlotFile,
    Policy,
    Seed,
    Severity,
    Weight,
    Workers,
    console,
)
from depal.errors import SettingError

if TYPE_CHECKING:
    from depal.app.reports import Report

study = typer.Typer(help="The paper's case studies, and beyond.", no_args_is_help=True)

Pallets = Annotated[int, typer.Option(help="How many random pallets.", min=1)]


def finish(report: "Report", json_file: Path | None, plot: Path | None) -> None:
    """Prints, writes and draws a report; exit status 1 where something must hold and does not."""
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
    if not report.holds:
        raise typer.Exit(1)


def check_targets(json_file: Path | None, plot: Path | None) -> None:
    """Refuses files that cannot be written, before anything is worked on."""
    from depal.app.files import checked_targets  # noqa: PLC0415 - fast help

    checked_targets(json_file, plot)


@study.command()
def table1(
    pallets: Pallets = 10_000,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine",
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Table I: boxes stored before the requested one, by h alone and by s."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import table1_report  # noqa: PLC0415
    from depal.studies.pallets import named_generators  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415
    from depal.studies.table1 import table1 as run  # noqa: PLC0415

    check_targets(json_file, plot)
    names = named_generators(generators)
    if plot is not None and len(names) > 1:
        what = f"a picture shows one generator, {len(names)} are named"
        raise SettingError("--plot", what, "one name in --generators")
    start = time.perf_counter()
    results = []
    with executor_for(workers, dask) as executor:
        for name in names:
            with progress_bar(f"Table I, {name}") as progress:
                results.append(run(pallets, seed, name, executor=executor, progress=progress))
    finish(table1_report(results, time.perf_counter() - start), json_file, plot)


@study.command()
def fig8(
    pallets: Pallets = 10_000,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Fig. 8: the average number of actions saved, over the weight."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import fig8_report  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415
    from depal.studies.table1 import table1 as run  # noqa: PLC0415

    check_targets(json_file, plot)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Fig. 8") as progress:
        result = run(pallets, seed, executor=executor, progress=progress)
    finish(fig8_report(result, time.perf_counter() - start), json_file, plot)


@study.command()
def fig9(
    pallets: Pallets = 1_000,
    w: Weight = 0.9,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Fig. 9: the pile after 20 steps in both modalities, and how much of it stands in pillars."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import fig9_report  # noqa: PLC0415
    from depal.studies.fig9 import fig9 as run  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Fig. 9") as progress:
        result = run(pallets, seed, w, executor=executor, progress=progress)
    finish(fig9_report(result, pallets, seed, time.perf_counter() - start), json_file, plot)


@study.command()
def case2(
    draws: Annotated[int, typer.Option(help="Jittered draws per layout.", min=0)] = 1_000,
    seed: Seed = 0,
    w: Weight = 0.2,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Case study 2 on geometry alone: Fig. 10's ten boxes, with and without the request."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import case2_report  # noqa: PLC0415
    from depal.studies.case2 import case2 as run  # noqa: PLC0415

    check_targets(json_file, plot)
    start = time.perf_counter()
    with progress_bar("Case study 2") as progress:
        results = run(draws=draws, seed=seed, w=w, progress=progress)
    finish(case2_report(results, w, seed, time.perf_counter() - start), json_file, plot)


@study.command()
def fig4(json_file: JsonFile = None, plot: PlotFile = None) -> None:
    """Fig. 4: the priority h over the pallet."""
    from depal.app.reports import fig4_report  # noqa: PLC0415 - fast help

    check_targets(json_file, plot)
    finish(fig4_report(), json_file, plot)


@study.command()
def fig5(json_file: JsonFile = None, plot: PlotFile = None) -> None:
    """Fig. 5: the graph G over a group of boxes, and T of a requested one."""
    from depal.app.reports import fig5_report  # noqa: PLC0415 - fast help

    check_targets(json_file, plot)
    finish(fig5_report(), json_file, plot)


@study.command()
def unload(
    deliveries: Annotated[
        str,
        typer.Option(help="A file of deliveries, FILE#ID for one of them; else those shipped."),
    ] = "",
    requests: Annotated[
        Path | None, typer.Option(help="A file of requests, known from the start.")
    ] = None,
    w: Weight = 0.5,
    json_file: JsonFile = None,
) -> None:
    """Real deliveries taken apart by Algorithm 1 on geometry alone, checked by a referee."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import unload_report  # noqa: PLC0415
    from depal.app.unload import unload_all  # noqa: PLC0415

    check_targets(json_file, None)
    start = time.perf_counter()
    with progress_bar("Unloading") as progress:
        results = unload_all(deliveries, requests, w, progress)
    finish(unload_report(results, w, time.perf_counter() - start), json_file, None)


@study.command()
def throughput(  # noqa: PLR0913, PLR0917 - a command's options
    deliveries: Annotated[
        str,
        typer.Option(help="A file of deliveries, FILE#ID for one of them; else those shipped."),
    ] = "",
    seeds: Annotated[int, typer.Option(help="How often each delivery is run.", min=1)] = 1,
    seed: Seed = 0,
    requests: Annotated[
        int,
        typer.Option("--requests-per-delivery", help="Random requests for each delivery.", min=0),
    ] = 3,
    cell: Annotated[
        str, typer.Option(help="A cell file, or the name of one that ships.")
    ] = "default",
    w: Weight = 0.5,
    perception: Perception = "truth",
    severity: Severity = "normal",
    policy: Policy = "paper",
    workers: Workers = 1,
    dask: Dask = None,
    keep: Keep = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Deliveries emptied in the simulated cell; exit status 1: lost, hit or booked wrongly."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.throughput import Asked, throughput_report  # noqa: PLC0415
    from depal.app.throughput import throughput as run  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    asked = Asked(deliveries, cell, w, requests, seeds, seed, perception, severity, policy)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Throughput") as progress:
        result = run(asked, keep, executor, progress)
    finish(throughput_report(result, asked, time.perf_counter() - start), json_file, plot)
