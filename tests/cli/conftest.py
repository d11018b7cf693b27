"""The command as a test calls it."""

import sys
from collections.abc import Callable

import pytest

from depal.cli import main

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(name="depal")
def _depal(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Exit status, output and errors of `depal` with some words."""

    def run(*words: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["depal", *map(str, words)])
        status = 0
        try:
            main()
        except SystemExit as stop:
            status = int(stop.code or 0)
        printed = capsys.readouterr()
        return status, printed.out, printed.err

    return run
