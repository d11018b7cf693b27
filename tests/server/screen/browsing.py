"""A served screen and a browser before it, for the browser test."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = Path(os.environ.get("DEPAL_CHROMIUM", "/usr/bin/chromium"))

HERE = Path(__file__).parent

DELIVERY = HERE / "tuesday.json"

ARGUMENTS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)

COUNT_CLICKS = """
addEventListener('click', (event) => {
  if (event.isTrusted) sessionStorage.clicks = Number(sessionStorage.clicks || 0) + 1;
}, true);
"""

SMALL = """
() => [...document.querySelectorAll('button, a, input, [role=slider]')]
  .filter((each) => each.offsetParent !== null)
  .map((each) => [each.outerHTML.slice(0, 120), each.getBoundingClientRect()])
  .filter(([_, box]) => box.width < 44 || box.height < 44)
  .map(([html, box]) => `${box.width} x ${box.height}: ${html}`)
"""
"""What a glove would miss."""

AXE = """
() => axe.run(document.querySelector('.q-dialog') || document, {resultTypes: ['violations']})
"""


def missing(what: str) -> None:
    """Skips with a reason; where a browser is required, that is a failure."""
    if "browser" in os.environ.get("DEPAL_REQUIRE", ""):
        pytest.fail(f"{what}, and DEPAL_REQUIRE asks for a browser")
    print(f"no browser test: {what}")  # noqa: T201 - whoever runs the tests should know
    pytest.skip(what)


def axe_script() -> str | None:
    """The text of axe; None where the package that carries it is not installed."""
    try:
        import axe_playwright_python as package  # noqa: PLC0415 - it may not be there
    except ImportError:
        return None
    return Path(str(package.__file__)).with_name("axe.min.js").read_text("utf-8")


def artefacts() -> Path:
    """Where pictures are kept for whoever looks at them after the test."""
    folder = Path(os.environ.get("DEPAL_ARTEFACTS", "build/screenshots"))
    folder.mkdir(parents=True, exist_ok=True)
    return folder


@contextmanager
def served(folder: Path, step: float) -> Iterator[str]:
    """A served scripted cell; yields the first link."""
    plain = {name: value for name, value in os.environ.items() if "PYTEST" not in name}
    command = [sys.executable, str(HERE / "served.py"), str(folder), str(step)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=plain) as process:  # noqa: S603 - our own command
        try:
            assert process.stdout is not None
            link = process.stdout.readline().strip()
            assert link, "the server has not begun"
            yield link
        finally:
            process.terminate()
            process.wait(20)


@contextmanager
def browser(folder: Path, **options: Any) -> Iterator[Any]:  # noqa: ANN401 - Playwright may not be there
    """A browser with a profile of its own."""
    if not CHROMIUM.exists() and shutil.which(str(CHROMIUM)) is None:
        missing(f"there is no {CHROMIUM}")
    try:
        from playwright.sync_api import sync_playwright  # noqa: PLC0415 - it may not be there
    except ImportError:
        missing("Playwright is not installed")
    with sync_playwright() as playwright:
        context = playwright.chromium.launch_persistent_context(
            str(folder),
            executable_path=str(CHROMIUM),
            headless=False,
            args=list(ARGUMENTS),
            viewport={"width": 1280, "height": 800},
            reduced_motion="reduce",
            **options,
        )
        context.set_default_timeout(60_000)
        yield context
        context.close()
