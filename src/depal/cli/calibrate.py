"""`depal calibrate`: where the cameras stand, by the markers of the cell."""

from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import JsonFile, PlotFile, Seed, console


def calibrate(
    cell: Annotated[str, typer.Option(help="A cell file or the name of a shipped cell.")] = (
        "default"
    ),
    frames: Annotated[
        Path | None,
        typer.Option(
            help="Recorded frames: a folder of them for each camera, named after it. Without it "
            "the simulated cameras look.",
            show_default=False,
        ),
    ] = None,
    camera: Annotated[
        str | None, typer.Option(help="This camera alone.", show_default=False)
    ] = None,
    pictures: Annotated[
        int, typer.Option(help="How many each simulated camera takes.", min=1, max=100)
    ] = 10,
    seed: Seed = 0,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Find camera poses and depth scales from the cell's markers; status 1 where they disagree.

    The file of --json keeps them for other commands.
    """
    from depal.app.calibrate import calibration_report  # noqa: PLC0415 - fast help
    from depal.app.files import checked_targets, write_json  # noqa: PLC0415
    from depal.studies.drawing import save_figure  # noqa: PLC0415

    checked_targets(json_file, plot)
    report = calibration_report(cell, frames, camera, pictures, seed)
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
