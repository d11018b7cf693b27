"""`depal replay`: a recorded run, decision by decision."""

from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import JsonFile, console
from depal.errors import SettingError, did_you_mean


def replay(
    record: Annotated[Path, typer.Argument(help="The folder of a recorded run.")],
    at: Annotated[
        int | None, typer.Option(help="Show a tree as it stood after this event.")
    ] = None,
    tree: Annotated[int | None, typer.Option(help="Which tree; else the first.")] = None,
    form: Annotated[
        str, typer.Option("--format", help="Of the tree: text, svg or mermaid.")
    ] = "text",
    out: Annotated[Path | None, typer.Option(help="Write the tree to this file.")] = None,
    every: Annotated[bool, typer.Option("--all", help="Changes of facts and timers too.")] = False,  # noqa: FBT002
    why: Annotated[
        str | None,
        typer.Option(
            help="Why boxes were chosen: all, the number of a choice, or a box's name.",
            show_default=False,
        ),
    ] = None,
    json_file: JsonFile = None,
) -> None:
    """Show a recorded run, decide it again, draw its trees at any moment, explain its choices."""
    from depal.app.files import checked_target, write_json, write_text  # noqa: PLC0415 - fast help
    from depal.app.replay import FORMS, replay_report, tree_at  # noqa: PLC0415
    from depal.app.whys import why_report  # noqa: PLC0415

    checked_target(json_file, "--json")
    checked_target(out, "--out")
    if form not in FORMS:
        raise SettingError("--format", f"unknown format {form!r}", exists=did_you_mean(form, FORMS))
    if at is not None or tree is not None or out is not None:
        text = tree_at(record, at, tree, form)
        if out is not None:
            write_text(out, text + "\n", "--out")
        else:
            typer.echo(text)
        return
    report = replay_report(record, every=every) if why is None else why_report(record, why)
    for part in report.shown:
        console().print(part, highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)
    if not report.holds:
        raise typer.Exit(1)
