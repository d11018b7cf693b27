"""How firmly a pile stands, whole or without some of its boxes: asked again and again."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np

from depal.domain import BoxId
from depal.errors import PileError, Problem
from depal.geometry import first_unsound
from depal.selection.stability.body import Body
from depal.selection.stability.certificate import Certificate, Direction, Proof
from depal.selection.stability.doubt import SURE, Doubt, cases_of
from depal.selection.stability.patches import (
    FIRST,
    KNOWN,
    ON_TOP,
    WAY,
    Array,
    Indices,
    TouchRule,
    touches_of,
)
from depal.selection.stability.program import LEAST, Sustained, sustained
from depal.selection.stability.spreading import STANDS

DIRECTIONS: tuple[Direction, ...] = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
"""The pushes that a margin is asked for."""


@dataclass(frozen=True, slots=True)
class Friction:
    """Of what stands on something, and of side faces.

    Side faces do not hold by friction: nothing presses cases together sideways. With friction
    there the program finds forces for boxes that hang between others, and they fall.
    """

    under: float = 0.5
    beside: float = 0.0


@dataclass(frozen=True, slots=True)
class _Found:
    """The margin in one case and direction [g], and the rows that limit it."""

    value: float
    case: int
    direction: int
    limiting: tuple[int, ...]
    exact: bool


class StandingPile:
    """Boxes with masses, their contacts in every case of a set, and what was found before.

    The set over which margins are the worst is made once; what does not depend on a removal is
    not worked out again: parts of a pile that do not touch it keep their margins.
    """

    def __init__(
        self,
        prisms: Array,
        masses: Array,
        *,
        names: Sequence[BoxId] = (),
        shares: Array | float = 0.0,
        doubt: Doubt = SURE,
        rule: TouchRule = KNOWN,
        deck: float = 0.0,
        friction: Friction = Friction(),
    ) -> None:
        """Finds every contact.

        Args:
            prisms: (n, 8) the boxes.
            masses: (n,) [kg].
            names: (n) of the boxes; else their rows.
            shares: (n,) or one for all: how wrong each mass may be, in [0, 1).
            doubt: how wrong poses may be, and how many lots are drawn.
            rule: when boxes touch.
            deck: the height on which the pile stands [m].
            friction: of contacts.

        Raises:
            PileError: a box has no place or no size, or a mass is none.
        """
        _check(prisms, masses)
        self.names = tuple(names) or tuple(BoxId(str(row)) for row in range(len(prisms)))
        self.friction = friction
        spread = np.broadcast_to(np.asarray(shares, float), masses.shape)
        self._cases: list[tuple[str, Body]] = []
        hanging = _hanging(prisms, rule, deck)
        for name, placed, weights in cases_of(prisms, masses, spread, doubt):
            touches = touches_of(placed, rule, deck, hanging)
            self._cases.append((name, Body.of(placed, weights, touches)))
        self.assumed = tuple(self.names[row] for row in hanging.tolist())
        self._solved: dict[tuple[int, int, bytes], Sustained] = {}

    def __len__(self) -> int:
        """How many boxes."""
        return len(self.names)

    def certificate(
        self, without: Collection[int] = (), at_least: float | None = None
    ) -> Certificate:
        """The margin of the pile when some boxes are taken away.

        Args:
            without: rows that are not there.
            at_least: a margin that is enough [g]: where forces for it are found quickly the
                answer is a lower bound, and where one case falls short the rest of the set is
                not looked at; None for the exact margin.

        Returns:
            The worst margin over the set.
        """
        left = np.ones(len(self), np.bool_)
        left[list(without)] = False
        enough = np.inf if at_least is None else at_least
        if not left.any():
            return Certificate(
                self.friction.under, Proof.EXACT, DIRECTIONS[0], (), len(self._cases)
            )
        bodies = [body.only(left) for _, body in self._cases]
        found = [self._bounds(case, body, enough) for case, body in enumerate(bodies)]
        least = [min(bounds, key=_value) for bounds in found]
        weakest = min(least, key=_value)
        if weakest.value >= enough:
            return self._certificate(weakest, Proof.AT_LEAST)
        order = sorted(range(len(bodies)), key=lambda case: least[case].value)
        solved: list[_Found] = []
        for number, case in enumerate(order):
            solved += [self._improved(bodies[case], bound, enough) for bound in found[case]]
            weakest = min(solved, key=_value)
            if weakest.value < enough < np.inf and number + 1 < len(order):
                return self._certificate(weakest, Proof.AT_MOST)
        enough_found = weakest.value >= enough or not weakest.exact
        return self._certificate(weakest, Proof.AT_LEAST if enough_found else Proof.EXACT)

    def quick_bound(self, without: Collection[int] = ()) -> float:
        """The margin that is found box by box from the top, as believed and without side faces.

        Args:
            without: rows that are not there.

        Returns:
            [g]; LEAST where no forces are found even at rest.
        """
        left = np.ones(len(self), np.bool_)
        left[list(without)] = False
        body = self._cases[0][1].only(left)
        return max(LEAST, min(bound.value for bound in self._bounds(0, body, np.inf)))

    def _bounds(self, case: int, body: Body, enough: float) -> list[_Found]:
        """What is found box by box from the top, in each direction."""
        found = []
        for direction, push in enumerate(DIRECTIONS):
            value, row = body.bound(push, self.friction.under, enough)
            limiting = () if row == STANDS else (row,)
            found.append(_Found(value, case, direction, limiting, exact=False))
        return found

    def _improved(self, body: Body, bound: _Found, enough: float) -> _Found:
        """The program's answer in one case and direction; the bound where that is enough."""
        if bound.value >= enough:
            return bound
        push = DIRECTIONS[bound.direction]
        answers = []
        for rows in body.parts():
            part = body.only(rows)
            if enough == np.inf or part.falling(push, enough, self.friction.under) != STANDS:
                answers.append(self._sustained(part, bound.case, bound.direction))
        worst = min(answers, key=lambda answer: answer.most)
        if not all(answer.solved for answer in answers):
            return bound
        # Where nothing stands at rest no box is the limit; the first for which no forces were
        # found says the most.
        limiting = worst.limiting if worst.most > LEAST else bound.limiting
        return _Found(worst.most, bound.case, bound.direction, limiting, exact=True)

    def _sustained(self, part: Body, case: int, direction: int) -> Sustained:
        """The program, solved once for each part."""
        key = case, direction, part.there.tobytes()
        if key not in self._solved:
            self._solved[key] = sustained(
                part.centres,
                part.masses,
                part.touches,
                (self.friction.under, self.friction.beside),
                DIRECTIONS[direction],
                self.friction.under,
            )
        return self._solved[key]

    def _certificate(self, found: _Found, proof: Proof) -> Certificate:
        return Certificate(
            margin=max(found.value, LEAST),
            proof=proof,
            direction=DIRECTIONS[found.direction],
            limiting=tuple(self.names[row] for row in found.limiting),
            cases=len(self._cases),
            worst=self._cases[found.case][0],
        )


def _value(found: _Found) -> float:
    return found.value


def _hanging(prisms: Array, rule: TouchRule, deck: float) -> Indices:
    """The rows below which nothing is seen: what carries them is hidden."""
    touches = touches_of(prisms, replace(rule, inset=0.0), deck, np.empty(0, np.int32))
    standing = touches.bodies[touches.bodies[:, WAY] == ON_TOP, FIRST]
    return np.setdiff1d(np.arange(len(prisms), dtype=np.int32), standing)


def _check(prisms: Array, masses: Array) -> None:
    """Refuses boxes without place or size, and masses that are none."""
    row = first_unsound(prisms, 0, len(prisms))
    if row >= 0:
        what = f"box {row} has no place or no size"
        raise PileError("", [Problem("pile", what, "finite numbers and sizes above 0 m")])
    bad = np.flatnonzero(~(np.isfinite(masses) & (masses > 0)))
    if len(bad):
        what = f"box {bad[0]} weighs {masses[bad[0]]!r} kg"
        raise PileError("", [Problem("pile", what, "masses above 0 kg")])
