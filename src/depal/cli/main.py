"""`depal`: the commands, and how they fail."""

import json
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.text import Text

from depal import __version__
from depal.cli.bench import bench
from depal.cli.beyond import beyond
from depal.cli.calibrate import calibrate
from depal.cli.cell import cell
from depal.cli.delivery import delivery
from depal.cli.learn import learn
from depal.cli.output import console
from depal.cli.replay import replay
from depal.cli.run import run
from depal.cli.see import see
from depal.cli.serve import backup, serve
from depal.cli.study import study
from depal.cli.tasks import tasks
from depal.errors import DepalError, InputError, JournalError, SettingError, did_you_mean

app = typer.Typer(
    help="An open depalletizing cell for the back room of a supermarket.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
study.add_typer(beyond)
app.add_typer(study, name="study")
app.add_typer(bench, name="bench")
app.add_typer(delivery, name="delivery")
app.add_typer(cell, name="cell")
app.add_typer(tasks, name="tasks")
app.command()(run)
app.command()(replay)
app.command()(calibrate)
app.command()(see)
app.command()(learn)
app.command()(serve)
app.command()(backup)


def main() -> None:
    """Runs a command; what is wrong with an input is one message and exit status 2."""
    try:
        app()
    except (InputError, JournalError) as error:
        _say(error)
        sys.exit(2)
    except DepalError as error:
        _say(error)
        sys.exit(1)


def _say(error: DepalError) -> None:
    Console(stderr=True, soft_wrap=True).print(
        f"error: {error}", style="red", markup=False, highlight=False
    )


def _version(wanted: bool) -> None:  # noqa: FBT001 - typer's callback
    if wanted:
        typer.echo(f"depal {__version__}")
        raise typer.Exit


@app.callback()
def _depal(
    *,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Say the version.")
    ] = False,
) -> None:
    """Holds the options of `depal` itself."""
    del version


@app.command()
def schema(
    name: Annotated[str, typer.Argument(help="cell, delivery, faults, orders or requests")] = "",
) -> None:
    """Print the JSON Schema of a format."""
    from depal.app.learning import order_schema  # noqa: PLC0415 - fast help
    from depal.cell.files import cell_schema  # noqa: PLC0415
    from depal.logistics import delivery_schema, requests_schema  # noqa: PLC0415
    from depal.simulation.faults import faults_schema  # noqa: PLC0415

    schemas = {
        "cell": cell_schema,
        "delivery": delivery_schema,
        "faults": faults_schema,
        "orders": order_schema,
        "requests": requests_schema,
    }
    if name not in schemas:
        what = f"unknown format {name!r}" if name else "no format named"
        raise SettingError("depal schema", what, exists=did_you_mean(name, schemas))
    typer.echo(json.dumps(schemas[name](), indent=2))


@app.command()
def doctor(
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write the findings to this file.")
    ] = None,
) -> None:
    """Say what works on this machine; exit status 1 where something that is needed does not."""
    from depal.app.doctor import examine  # noqa: PLC0415 - fast help
    from depal.app.files import checked_target, write_json  # noqa: PLC0415

    checked_target(json_file, "--json")
    findings = examine()
    marks = {True: ("works  ", "green"), False: ("BROKEN ", "red"), None: ("missing", "dim")}
    for finding in findings:
        mark = Text.assemble(marks[finding.works], f" {finding.name}: {finding.detail}")
        console().print(mark, highlight=False)
    if json_file is not None:
        write_json(json_file, {"findings": [finding.fields for finding in findings]})
    if any(finding.works is False for finding in findings):
        raise typer.Exit(1)
