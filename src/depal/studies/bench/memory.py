"""The peak of memory of this process."""

import re
import resource
import sys
from pathlib import Path

STATUS = Path("/proc/self/status")


def peak_megabytes(status: Path = STATUS) -> float:
    """The most memory that this process has had at once [MB].

    Where the system tells it, the peak since the program was started: what `getrusage` says begins
    with the peak of the process that has started this one.

    Args:
        status: the file in which Linux tells it; where there is none, `getrusage` is asked.
    """
    if status.exists():
        found = re.search(r"^VmHWM:\s+(\d+) kB$", status.read_text(encoding="ascii"), re.MULTILINE)
        if found:
            return int(found[1]) / 1e3
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e6 if sys.platform == "darwin" else 1e3)
