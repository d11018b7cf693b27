"""The one place that names the compiler of the hot loops."""

from collections.abc import Callable
from typing import TypeVar, cast

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
