"""The peak of memory is this program's own, whoever has started it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from depal.studies.bench.memory import STATUS, peak_megabytes

MEASURED = "from depal.studies.bench.memory import peak_megabytes as p; print(p())"


@pytest.mark.skipif(not STATUS.exists(), reason="the system tells no peak of one program")
def test_a_program_does_not_inherit_the_peak_of_the_one_that_has_started_it() -> None:
    """Half a gigabyte here does not show there."""
    block = np.ones(500_000_000, np.uint8)
    assert peak_megabytes() > block.nbytes / 1e6
    command = [sys.executable, "-c", MEASURED]
    run = subprocess.run(command, capture_output=True, text=True, check=True)  # noqa: S603
    assert 0 < float(run.stdout) < 400


def test_where_the_system_tells_no_peak_the_usage_is_asked(tmp_path: Path) -> None:
    """An empty status, and none."""
    empty = tmp_path / "status"
    empty.write_text("Name: python\n", encoding="ascii")
    assert peak_megabytes(empty) >= 0.9 * peak_megabytes()
    assert peak_megabytes(tmp_path / "none") == pytest.approx(peak_megabytes(empty), rel=0.1)
