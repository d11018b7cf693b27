"""Where commands print to, and the options that many of them share."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

JsonFile = Annotated[
    Path | None, typer.Option("--json", help="Write the result to this file.", show_default=False)
]
PlotFile = Annotated[
    Path | None,
    typer.Option(
        "--plot", help="Draw the figure into this file (.png, .svg, .pdf).", show_default=False
    ),
]
Seed = Annotated[int, typer.Option(help="Of every random number.", min=0)]
Workers = Annotated[int, typer.Option(help="How many processes work.", min=1)]
Dask = Annotated[
    str | None,
    typer.Option(help="Work on the Dask cluster at this address.", show_default=False),
]

Keep = Annotated[
    Path | None,
    typer.Option(
        help="Keep finished runs in this folder; an interrupted study goes on from there.",
        show_default=False,
    ),
]

TaskFiles = Annotated[
    list[str] | None,
    typer.Option(
        metavar="FILE",
        help="A task file in place of the shipped ones; once for each file.",
        show_default=False,
    ),
]

Weight = Annotated[float, typer.Option("--w", help="The weight of the requests, in [0, 1].")]
Policy = Annotated[str, typer.Option(help="Which boxes may be taken: paper, or access.")]
Perception = Annotated[str, typer.Option(help="Where boxes come from: camera, or truth.")]
Severity = Annotated[
    str, typer.Option(help="How far cameras and prints are from ideal: easy, normal, hard.")
]

_PIPE_WIDTH = 132


def console() -> Console:
    """The standard output; wide enough for our tables where it is no terminal."""
    return Console(width=None if sys.stdout.isatty() else _PIPE_WIDTH)
