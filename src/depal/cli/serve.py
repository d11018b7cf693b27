"""`depal serve` and `depal backup`."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from depal.cli.output import TaskFiles

Folder = Annotated[Path, typer.Option("--data", help="The folder in which everything is kept.")]


def serve(  # noqa: PLR0913, PLR0917 - a command's options
    host: Annotated[str, typer.Option(help="The address to listen at.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="The port; 0 for any.", min=0, max=65535)] = 8080,
    cell: Annotated[
        str, typer.Option(help="A cell file, or the name of one that ships.")
    ] = "default",
    tasks: TaskFiles = None,
    db: Annotated[
        str, typer.Option(help="The store's database; a file in the data folder by default.")
    ] = "",
    data: Folder = Path("depal-data"),
    name: Annotated[
        list[str] | None, typer.Option(help="A name by which browsers may ask for the cell.")
    ] = None,
    perception: Annotated[str, typer.Option(help="camera or truth.")] = "camera",
    severity: Annotated[str, typer.Option(help="easy, normal or hard.")] = "normal",
    pace: Annotated[float, typer.Option(help="Seconds of the simulated world per second.")] = 1.0,
    *,
    secure: Annotated[
        bool, typer.Option("--secure", help="A proxy before it speaks TLS with the browsers.")
    ] = False,
) -> None:
    """The cell behind the operator's screen and the HTTP API, until Ctrl-C or SIGTERM."""
    from depal.app.serve.serving import Serving  # noqa: PLC0415 - fast help
    from depal.app.serve.serving import serve as run  # noqa: PLC0415

    asked = Serving(
        cell,
        data,
        db,
        host,
        port,
        tuple(name or ()),
        secure,
        perception,
        severity,
        pace,
        tuple(tasks or ()),
    )
    console = Console()
    run(asked, lambda link: console.print(f"The screen: {link}", soft_wrap=True))


def backup(
    to: Annotated[Path, typer.Argument(help="A new folder for the copy.")],
    data: Folder = Path("depal-data"),
) -> None:
    """A consistent copy of the store's data and of all runs, while the cell works."""
    from depal.app.serve.backup import back_up  # noqa: PLC0415 - fast help

    Console().print(back_up(data, to), soft_wrap=True)
