"""What the store wants first."""

import math
from dataclasses import dataclass

from depal.domain.names import BoxId, Gtin
from depal.domain.settings import checked_share
from depal.errors import Problem, RequestError


@dataclass(frozen=True, slots=True)
class Request:
    """A product or one perceived box that is wanted: an element of R with its p (section II-C).

    Exactly one of `gtin` and `box` is set. A product request is served by the first case of
    that product that leaves the pallet; a box request by that box alone.

    Attributes:
        priority: p, the importance of the request, in [0, 1].
        gtin: the product that is wanted.
        box: the perceived box that is wanted.
        arrived: when the request came [s since the start of the run].
        due: when it should be served [s since the start of the run], if at all.

    Raises:
        SettingError: the priority is not a number in [0, 1].
        RequestError: both or neither of product and box, or times that are not in order.
    """

    priority: float
    gtin: Gtin | None = None
    box: BoxId | None = None
    arrived: float = 0.0
    due: float | None = None

    def __post_init__(self) -> None:
        """Refuses what could never be served."""
        checked_share(f"priority of the request for {self.wanted}", self.priority)
        if (self.gtin is None) == (self.box is None):
            had = "neither" if self.gtin is None else "both"
            raise RequestError("", [Problem("request", f"{had} given", "either gtin or box")])
        if not (math.isfinite(self.arrived) and self.arrived >= 0):
            problem = Problem("arrived", f"{self.arrived!r} s is no time", "0 s or later")
            raise RequestError("", [problem])
        if self.due is not None and not self.due >= self.arrived:
            problem = Problem("due", f"{self.due!r} s is before it arrived", f">= {self.arrived} s")
            raise RequestError("", [problem])

    @property
    def wanted(self) -> str:
        """The name of what is wanted, for people."""
        if self.box is not None:
            return f"box {self.box}"
        return f"product {self.gtin}"
