"""`depal serve` in real processes: killed, and ended in order."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parent.parent.parent / "scripts" / "kill_cell.py"


@pytest.mark.slow
def test_ten_kills_of_the_controller_lose_nothing_and_double_nothing() -> None:
    """The world lives on; the referee, the stock and the requests agree at the end."""
    command = [sys.executable, str(SCRIPT), "--kills", "10"]
    done = subprocess.run(  # noqa: S603 - our own script
        command, capture_output=True, text=True, check=False, timeout=400
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
