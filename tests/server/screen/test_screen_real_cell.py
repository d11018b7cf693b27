"""The screen before the real cell: controller, executive, planner and physics, faster than real."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from browsing import COUNT_CLICKS, artefacts, browser
from test_screen_browser import MOST_CLICKS, Visit, sign_up


@pytest.fixture
def link(tmp_path: Path) -> Iterator[str]:
    """Of `depal serve` with an empty data folder."""
    plain = {name: value for name, value in os.environ.items() if "PYTEST" not in name}
    depal = str(Path(sys.executable).with_name("depal"))
    command = [depal, "serve", "--data", str(tmp_path / "data"), "--port", "0", "--pace", "6"]
    command += ["--perception", "truth"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=plain) as process:  # noqa: S603 - our own command
        assert process.stdout is not None
        line = process.stdout.readline()
        assert "/first?code=" in line, line
        yield line.split(": ", 1)[1].strip()
        process.terminate()
        assert process.wait(30) == 0


@pytest.mark.slow
def test_a_delivery_runs_after_three_clicks_and_is_watched_to_its_end(
    link: str, tmp_path: Path
) -> None:
    """From the printed link: the sample, a request, held and resumed, complete, and replayed."""
    with browser(tmp_path / "profile", locale="en-GB") as context:
        context.add_init_script(COUNT_CLICKS)
        context.set_default_timeout(180_000)  # six times real time, if the machine lets it
        visit = Visit(context.pages[0], artefacts())
        sign_up(visit, link)
        visit.press("Use a sample delivery", ".todo")
        visit.press("Start dev-035", ".todo")
        visit.mode("Working")
        assert int(visit.page.evaluate("sessionStorage.clicks")) <= MOST_CLICKS
        visit.page.locator(".queue tbody tr").nth(5).wait_for()
        visit.press("Hold", ".todo")
        visit.mode("Held")
        lowest = visit.queue()[-1]
        visit.press("Request a case", ".wishes .head")
        visit.chooses(f"Box {lowest}", lowest)
        visit.press("Now", ".form")
        visit.press("Request a case", ".form .acts")
        visit.sees(f"Box {lowest}", ".wish")
        visit.shot("real_held")
        visit.press("Resume", ".todo")
        visit.mode("Working")
        visit.mode("Complete")
        visit.shot("real_complete")
        assert "20 of 20 stored" in visit.page.locator("body").inner_text()
        visit.press("Past")
        visit.sees("dev-035", ".past-grid")
        visit.shot("real_past")
        assert visit.errors == []
