"""`depal see`: what perception finds in a frame."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from depal.cli.output import JsonFile, PlotFile, console


def see(
    frame: Annotated[
        str,
        typer.Argument(
            help="A frame's folder, a folder with the frames of one look, or "
            "simulated:DELIVERY[:SEED[:SEVERITY]] for a look of the simulated cell.",
            show_default=False,
        ),
    ],
    note: Annotated[
        str | None,
        typer.Option(
            help="What may stand there: FILE, FILE#ID or the name of a shipped delivery.",
            show_default=False,
        ),
    ] = None,
    book: Annotated[
        Path | None, typer.Option(help="The folder of a picture book.", show_default=False)
    ] = None,
    cell: Annotated[
        str | None,
        typer.Option(
            help="A cell file or the name of a shipped cell: look above its pallet only.",
            show_default=False,
        ),
    ] = None,
    json_file: JsonFile = None,
    plot: PlotFile = None,
) -> None:
    """Find boxes in a frame: detections, names, scores and relations, as JSON and as a picture.

    The JSON goes to the standard output; with --json to that file, and a table is printed instead.
    """
    from depal.app.files import checked_targets, report_text, write_json  # noqa: PLC0415 - fast help
    from depal.app.see import given  # noqa: PLC0415
    from depal.app.see.looking import look_at  # noqa: PLC0415
    from depal.studies.drawing import save_figure  # noqa: PLC0415

    checked_targets(json_file, plot)
    report = look_at(given(frame, note, book, cell))
    if json_file is None:
        typer.echo(report_text(report.fields), nl=False)
        out, shown = Console(stderr=True), report.shown[-1:]
    else:
        write_json(json_file, report.fields)
        out, shown = console(), report.shown
    for part in shown:
        out.print(part, highlight=False, markup=False)
    if plot is not None and report.draw is not None:
        save_figure(report.draw(), plot)
        out.print(f"figure: {plot}", highlight=False, markup=False)
