"""`depal delivery`: reads deliveries as the product will."""

from pathlib import Path
from typing import Annotated

import typer

from depal.cli.output import JsonFile, console

delivery = typer.Typer(help="Deliveries and their notes.", no_args_is_help=True)


@delivery.callback()
def _delivery() -> None:
    """Keeps `delivery` a group while it has one command."""


@delivery.command()
def check(
    file: Annotated[str, typer.Argument(help="FILE, FILE#ID or the name of a shipped delivery.")],
    requests: Annotated[
        Path | None, typer.Option(help="A file of requests to check against the note.")
    ] = None,
    json_file: JsonFile = None,
) -> None:
    """Read a delivery as the product will; everything that is wrong with it at once."""
    from depal.app.delivery import check_delivery  # noqa: PLC0415 - fast help
    from depal.app.files import checked_target, write_json  # noqa: PLC0415

    checked_target(json_file, "--json")
    report = check_delivery(file, requests)
    for part in report.shown:
        console().print(part, highlight=False, markup=False)
    if json_file is not None:
        write_json(json_file, report.fields)
