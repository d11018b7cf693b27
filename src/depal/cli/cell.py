"""`depal cell`: what a cell can do, before anything moves in it."""

from typing import Annotated

import typer

from depal.cli.output import JsonFile, PlotFile, console

cell = typer.Typer(help="Cells and their files.", no_args_is_help=True)


@cell.callback()
def _cell() -> None:
    """Keeps `cell` a group while it has few commands."""


@cell.command()
def check(
    file: Annotated[str, typer.Argument(help="A cell file or the name of a shipped cell.")] = (
        "default"
    ),
    delivery: Annotated[
        str | None,
        typer.Option(
            help="Try the boxes of this delivery: FILE, FILE#ID or the name of a shipped one.",
            show_default=False,
        ),
    ] = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Say which box sizes go where by which grasp and what the cameras see; status 1 on errors."""
    from depal.app.cell import cell_report  # noqa: PLC0415 - fast help
    from depal.app.files import checked_targets, write_json  # noqa: PLC0415
    from depal.studies.drawing import save_figure  # noqa: PLC0415

    checked_targets(json_file, plot)
    report = cell_report(file, delivery)
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


@cell.command()
def show(
    name: Annotated[str, typer.Argument(help="The name of a shipped cell.")] = "default",
) -> None:
    """Print the file of a shipped cell, to begin one's own from."""
    from depal.cell.files import shipped_text  # noqa: PLC0415 - fast help

    typer.echo(shipped_text(name), nl=False)
