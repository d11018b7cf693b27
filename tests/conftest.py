"""What every test may rely on."""

import os

from hypothesis import HealthCheck, settings

# Where examples decide whether a branch is covered, and where nobody is there to try again, the
# examples are the same every time; on a desk they are new every time.
# The first call of a kernel compiles it, and without the compiler everything is slow: no test
# is about the time of a single example.
_SLOW = os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}
settings.register_profile(
    "depal",
    deadline=None,
    derandomize=_SLOW or bool(os.environ.get("CI")),
    max_examples=15 if _SLOW else 60,
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
)
settings.load_profile("depal")
