"""`depal tasks`: checks, shows, explores and lays out task files."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from depal.cli.output import JsonFile, console

if TYPE_CHECKING:
    from depal.app.reports import Report

tasks = typer.Typer(help="Task files: what the cell does, and when.", no_args_is_help=True)

File = Annotated[str, typer.Argument(help="A task file, or a shipped one by name: store, cell.")]
Facts = Annotated[
    str | None,
    typer.Option(help="What is the case, as in b1.taken=true,b1.target=shelf."),
]


def _finish(report: "Report", json_file: Path | None) -> None:
    """Prints and writes a report; exit status 1 where something serious was found."""
    from depal.app.files import write_json  # noqa: PLC0415 - fast help

    for part in report.shown:
        console().print(part, highlight=False, soft_wrap=True)
    if json_file is not None:
        write_json(json_file, report.fields)
    if not report.holds:
        raise typer.Exit(1)


@tasks.command()
def check(
    files: Annotated[
        list[str],
        typer.Argument(metavar="FILE...", help="Task files, or shipped ones: store, cell."),
    ],
    cell: Annotated[
        str,
        typer.Option(
            help="The cell whose zones they may avoid: a file, or a shipped one by name.",
            show_default=False,
        ),
    ] = "",
    json_file: JsonFile = None,
) -> None:
    """Find mistakes before anything runs; exit status 1 where there is one."""
    from depal.app.files import checked_target  # noqa: PLC0415 - fast help
    from depal.app.tasks import check_report  # noqa: PLC0415

    checked_target(json_file, "--json")
    _finish(check_report(files, cell), json_file)


@tasks.command()
def show(
    file: File,
    task: Annotated[str, typer.Argument(help="As in store(b1), or store.")] = "",
    form: Annotated[str, typer.Option("--format", help="text, svg or mermaid.")] = "text",
    facts: Facts = None,
    out: Annotated[
        Path | None, typer.Option(help="Write the drawing to this file.", show_default=False)
    ] = None,
) -> None:
    """Draw a task; with facts, the states of its nodes."""
    from depal.app.files import checked_target, write_text  # noqa: PLC0415 - fast help
    from depal.app.tasks import drawing  # noqa: PLC0415

    checked_target(out, "--out")
    text = drawing(file, task, facts, form)
    if out is None:
        typer.echo(text, nl=False)
    else:
        write_text(out, text, "--out")


@tasks.command()
def explore(
    file: File,
    calls: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[TASK...]",
            help="As in store(b1), or store; several at once.",
            show_default=False,
        ),
    ] = None,
    limit: Annotated[int, typer.Option(help="Of the number of states.", min=1)] = 100_000,
    disturb: Annotated[
        list[str] | None,
        typer.Option(
            help="A fact that may change at any moment: Box.taken, or Box.taken=false.",
            show_default=False,
        ),
    ] = None,
    *,
    split: Annotated[
        bool, typer.Option("--split", help="Let changes of several facts come one by one.")
    ] = False,
    facts: Facts = None,
    json_file: JsonFile = None,
) -> None:
    """Walk every state of tasks, crashes included; exit status 1 where there is a hazard."""
    from depal.app.files import checked_target  # noqa: PLC0415 - fast help
    from depal.app.tasks import explore_report  # noqa: PLC0415

    checked_target(json_file, "--json")
    report = explore_report(
        file, calls or [], limit=limit, disturb=disturb or [], split=split, facts=facts
    )
    _finish(report, json_file)


@tasks.command(name="format")
def format_file(
    file: File,
    *,
    check_only: Annotated[
        bool, typer.Option("--check", help="Only say whether the layout is canonical.")
    ] = False,
    write: Annotated[bool, typer.Option("--write", help="Replace the file.")] = False,
) -> None:
    """Print a file in its canonical layout."""
    from depal.app.tasks import formatted  # noqa: PLC0415 - fast help

    text, same = formatted(file, write=write and not check_only)
    if not check_only and not write:
        typer.echo(text, nl=False)
    elif same:
        console().print(f"{file}: canonical", highlight=False, markup=False)
    elif check_only:
        console().print(f"{file}: not canonical", highlight=False, markup=False)
        raise typer.Exit(1)
    else:
        console().print(f"{file}: rewritten", highlight=False, markup=False)
