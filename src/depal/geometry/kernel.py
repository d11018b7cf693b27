"""The one place that names the compiler of the hot loops."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., object])


def kernel(function: F) -> F:
    """Compiles a function over arrays with numba, once per machine (cached on disk).

    A kernel releases the interpreter lock, follows numpy's rules for division, and is inlined
    where another kernel calls it. With NUMBA_DISABLE_JIT=1 it stays plain Python, which is how
    its branches are measured.
    """
    compiler = numba.njit(cache=True, nogil=True, error_model="numpy", forceinline=True)
    return cast("F", compiler(function))


def loop_kernel(function: F) -> F:
    """A kernel that makes no array of its own, only reads and writes those it is given.

    So it needs no reference counts, whose atomic steps cost more than a short loop's work: the
    graph of 200 boxes is built in half the time (numba's own option for this has no public
    name; it is named here alone).
    """
    options: dict[str, Any] = {"cache": True, "nogil": True, "forceinline": True, "_nrt": False}
    return cast("F", numba.njit(error_model="numpy", **options)(function))
