"""`depal study`: what goes beyond the paper's case studies."""

import time
from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import Dask, JsonFile, Keep, PlotFile, Seed, Weight, Workers
from depal.cli.study import Pallets, check_targets, finish
from depal.errors import SettingError

beyond = typer.Typer()

LIGHT = "light"

WORLDS = (LIGHT, "physics")
"""Of a long shift."""


@beyond.command()
def retrieval(  # noqa: PLR0913, PLR0917 - a command's options
    pallets: Pallets = 1_000,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine",
    side_only: Annotated[
        str, typer.Option(help="Shares of boxes that only a side grasp takes, with commas.")
    ] = "0,0.25,0.5,0.75,1",
    cell_pallets: Annotated[
        int, typer.Option(help="So many of them also with the tool's clearance and reach.", min=0)
    ] = 100,
    deliveries: Annotated[
        str,
        typer.Option(help="A file of deliveries, FILE#ID for one of them; else those shipped."),
    ] = "",
    cell: Annotated[
        str, typer.Option(help="A cell file, or the name of one that ships.")
    ] = "default",
    referee: Annotated[
        int, typer.Option(help="So many of each are proven again by another program.", min=0)
    ] = 100,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Removals before a requested box: the paper's rule and access, beside the proven minimum."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import retrieval_report  # noqa: PLC0415
    from depal.app.retrieval import RetrievalAsked  # noqa: PLC0415
    from depal.app.retrieval import retrieval as run  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    asked = RetrievalAsked(
        pallets, generators, side_only, cell_pallets, deliveries, cell, referee, seed
    )
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Retrieval") as progress:
        result = run(asked, executor, progress)
    finish(retrieval_report(result, asked, time.perf_counter() - start), json_file, plot)


@beyond.command()
def due(
    pallets: Pallets = 100,
    small: Annotated[
        int, typer.Option(help="So many of at most ten boxes, beside the exact optimum.", min=0)
    ] = 50,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine,dropped",
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Several requests with due times: weighted lateness by the paper's rule and by access."""
    from depal.app.due import due as run  # noqa: PLC0415 - fast help
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.reports import due_report  # noqa: PLC0415
    from depal.studies.pallets import named_generators  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    names = named_generators(generators)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Due times") as progress:
        rows = run(names, pallets, small, seed, executor, progress)
    report = due_report(rows, pallets, small, seed, time.perf_counter() - start)
    finish(report, json_file, plot)


@beyond.command()
def hidden(
    pallets: Pallets = 50,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine,layered,cubic,columns,dropped",
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """A box that nobody has seen is requested: the paper's rule waits, access searches."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import hidden_report  # noqa: PLC0415
    from depal.studies.hidden import hidden_rows  # noqa: PLC0415
    from depal.studies.pallets import named_generators  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    names = named_generators(generators)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Hidden boxes") as progress:
        rows = hidden_rows(names, pallets, seed, executor, progress)
    report = hidden_report(rows, pallets, seed, time.perf_counter() - start)
    finish(report, json_file, plot)


@beyond.command()
def stability(  # noqa: PLR0913, PLR0917 - a command's options
    pallets: Annotated[
        int,
        typer.Option(help="Pairs of unloadings of loose pallets, and of full packings.", min=1),
    ] = 1_000,
    states: Annotated[
        int, typer.Option(help="Random states that are compared with MuJoCo.", min=1)
    ] = 600,
    w: Weight = 0.2,
    threshold: Annotated[
        float, typer.Option(help="The guard's least margin, in g.", min=0.0)
    ] = 0.03,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Margins against MuJoCo, and collapses with and without a guard on them."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports import stability_report  # noqa: PLC0415
    from depal.studies.stability import stability as run  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Stability") as progress:
        result = run(pallets, states, seed, w, threshold, executor=executor, progress=progress)
    finish(stability_report(result, seed, time.perf_counter() - start), json_file, plot)


@beyond.command()
def benchmark(
    pallets: Pallets = 100,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine,layered,cubic,columns,dropped",
    into: Annotated[
        Path | None,
        typer.Option(help="Write the table between the marks of this page.", show_default=False),
    ] = None,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    json_file: JsonFile = None,
) -> None:
    """Every policy on every kind of pallet: actions, gap, lateness, collapses, margin, time."""
    from depal.app.progress import progress_bar  # noqa: PLC0415 - fast help
    from depal.app.reports.benchmark import (  # noqa: PLC0415
        benchmark_report,
        checked_page,
        write_into,
    )
    from depal.studies.benchmark import benchmark as run  # noqa: PLC0415
    from depal.studies.pallets import named_generators  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, None)
    if into is not None:
        checked_page(into)
    names = named_generators(generators)
    start = time.perf_counter()
    with executor_for(workers, dask) as executor, progress_bar("Benchmark") as progress:
        rows = run(names, pallets, seed, executor, progress)
    if into is not None:
        write_into(into, rows, pallets, seed)
    finish(benchmark_report(rows, pallets, seed, time.perf_counter() - start), json_file, None)


@beyond.command()
def learning(  # noqa: PLR0913, PLR0917 - a command's options
    pallets: Annotated[int, typer.Option(help="How many orders are drawn.", min=1)] = 200,
    seeds: Annotated[int, typer.Option(help="How often it is done.", min=1)] = 10,
    w: Annotated[float, typer.Option(help="The policy's w, in [0, 1].")] = 0.5,
    weights: Annotated[
        str, typer.Option(help="The policy's weights of |y|, x_max - x and z; scaled to sum 1.")
    ] = "1,2,4",
    temperature: Annotated[float, typer.Option(help="Of the policy's choices [m].")] = 0.01,
    requests: Annotated[int, typer.Option(help="Wanted boxes on each pallet.", min=0)] = 3,
    generators: Annotated[
        str, typer.Option(help="Names of generators, with commas between them.")
    ] = "guillotine,layered,cubic,columns,dropped",
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    orders: Annotated[
        Path | None,
        typer.Option(help="Write the first seed's orders to this .jsonl.", show_default=False),
    ] = None,
    json_file: JsonFile = None,
) -> None:
    """Orders drawn by a known policy, and how well `depal learn` recovers its weights."""
    from depal.app.files import checked_target  # noqa: PLC0415 - fast help
    from depal.app.learning import recovery_report, weights_of, write_orders  # noqa: PLC0415
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.studies.learning import Teacher, draw_order, recover  # noqa: PLC0415
    from depal.studies.pallets import named_generators  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, None)
    checked_target(orders, "--orders")
    names = named_generators(generators)
    teacher = Teacher(w, weights_of(weights), temperature, requests, names)
    start = time.perf_counter()
    if orders is not None:
        drawn = (draw_order(teacher, seed, index) for index in range(pallets))
        write_orders(orders, drawn, "--orders")
    with executor_for(workers, dask) as executor, progress_bar("Learning") as progress:
        results = recover(teacher, pallets, range(seed, seed + seeds), executor, progress)
    report = recovery_report(teacher, pallets, results, time.perf_counter() - start)
    finish(report, json_file, None)


@beyond.command()
def faults(  # noqa: PLR0913, PLR0917 - a command's options
    faults: Annotated[
        str, typer.Option(help="Ids of faults, with commas; all where none is named.")
    ] = "",
    seeds: Annotated[
        int, typer.Option(help="So many runs of each fault; 0: only what follows.", min=0)
    ] = 3,
    pairs: Annotated[
        int, typer.Option(help="So many runs with two random faults of these.", min=0)
    ] = 0,
    cuts: Annotated[
        int,
        typer.Option(
            help="In a light world: end the controller at every write of a run, and at so many "
            "random moments.",
            min=0,
        ),
    ] = 0,
    shift: Annotated[
        int,
        typer.Option(help="So many boxes of a long shift, with faults at published rates.", min=0),
    ] = 0,
    world: Annotated[
        str, typer.Option(help="Of the shift: light, or physics on real deliveries.")
    ] = LIGHT,
    seed: Seed = 0,
    workers: Workers = 1,
    dask: Dask = None,
    replay: Annotated[
        str, typer.Option(help="Run this one again: G3:7, or G3+M7:7.", metavar="RUN")
    ] = "",
    record: Annotated[
        Path | None, typer.Option(help="With --replay: keep its record in this new folder.")
    ] = None,
    keep: Keep = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Every fault alone, pairs, crash cuts and a long shift: what ends how, and what is lost."""
    from depal.app.faults import (  # noqa: PLC0415 - fast help
        FaultsAsked,
        Piece,
        Whole,
        replay_report,
        run_one,
        whole_report,
    )
    from depal.app.light import Storm  # noqa: PLC0415
    from depal.app.progress import progress_bar  # noqa: PLC0415
    from depal.app.run.inputs import one_of  # noqa: PLC0415
    from depal.studies.sweep import executor_for  # noqa: PLC0415

    check_targets(json_file, plot)
    if record is not None and not replay:
        raise SettingError("--record", "a study keeps no records", "--replay RUN beside it")
    if replay:
        finish(replay_report(run_one(Piece.of(replay), record)), json_file, plot)
        return
    asked = Whole(
        FaultsAsked(faults, seeds, seed, pairs),
        Storm(cuts, shift if one_of("--world", world, WORLDS) == LIGHT else 0, seed),
        0 if world == LIGHT else shift,
        keep,
    )
    with executor_for(workers, dask) as executor:
        report = whole_report(asked, executor, progress_bar)
    finish(report, json_file, plot)
