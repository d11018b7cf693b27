"""`depal run`: the main job."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from depal.cli.output import (
    JsonFile,
    Perception,
    Policy,
    Seed,
    Severity,
    TaskFiles,
    Weight,
    console,
)

Guard = Annotated[
    bool,
    typer.Option("--guard", help="Let boxes wait whose removal leaves a pile with < 0.03 g."),
]
Record = Annotated[
    Path | None,
    typer.Option(help="Keep a record with pictures in this folder.", show_default=False),
]


def run(  # noqa: PLR0913, PLR0917 - a command's options
    delivery: Annotated[
        str,
        typer.Argument(
            help="FILE, FILE#ID, the id of a delivery that ships, or case2: the paper's ten boxes.",
            show_default=False,
        ),
    ] = "",
    cell: Annotated[
        str, typer.Option(help="A cell file, or the name of one that ships.")
    ] = "default",
    tasks: TaskFiles = None,
    note: Annotated[
        str,
        typer.Option(
            help="The note that the cell is told instead: FILE or FILE#ID, JSON or CSV.",
            show_default=False,
        ),
    ] = "",
    requests: Annotated[
        str, typer.Option(help="A file of requests, or none.", show_default=False)
    ] = "",
    faults: Annotated[
        str, typer.Option(help="A file of faults that strike.", show_default=False)
    ] = "",
    w: Weight = 0.5,
    policy: Policy = "paper",
    guard: Guard = False,  # noqa: FBT002 - a flag
    perception: Perception = "camera",
    severity: Severity = "normal",
    seed: Seed = 0,
    speed: Annotated[float, typer.Option(help="Share of the arm's full speed, in (0, 1].")] = 1.0,
    record: Record = None,
    json_file: JsonFile = None,
) -> None:
    """Empty a pallet in the simulated cell: physics, motions, tasks and choices."""
    from depal.app.files import checked_target, write_json  # noqa: PLC0415 - fast help
    from depal.app.run.job import run_delivery  # noqa: PLC0415
    from depal.app.run.values import Options  # noqa: PLC0415

    checked_target(json_file, "--json")
    options = Options(
        delivery=delivery,
        cell=cell,
        note=note,
        requests=requests,
        faults=faults,
        w=w,
        policy=policy,
        guard=guard,
        perception=perception,
        severity=severity,
        seed=seed,
        speed=speed,
        record=record,
        tasks=tuple(tasks or ()),
    )
    warn = Console(stderr=True, soft_wrap=True)
    report = run_delivery(
        options,
        watch=True,
        say=lambda text: warn.print(f"left to a person: {text}", style="yellow", markup=False),
    )
    for part in report.shown:
        console().print(part, highlight=False)
    if json_file is not None:
        write_json(json_file, report.fields)
    if not report.holds:
        raise typer.Exit(1)
