"""Margins: what statics says of simple piles, and laws of all piles."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import BoxId, Detection, Gtin, Product, Recognition
from depal.errors import PileError, SettingError
from depal.geometry import OrientedBox, prisms_of
from depal.selection.stability import (
    CAMERA,
    EDGE,
    KNOWN,
    LEAST,
    SEEN,
    Certificate,
    Doubt,
    Friction,
    Proof,
    StandingPile,
    TouchRule,
    weigh,
)
from depal.selection.stability import program as program_module
from depal.selection.stability.body import Body
from depal.selection.stability.patches import touches_of

Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


def prisms(*boxes: tuple[float, float, float, float, float, float]) -> Array:
    """From corners with the smallest coordinates and sizes."""
    return prisms_of(OrientedBox.from_corner(b[:3], b[3:]) for b in boxes)


def ones(boxes: Array) -> Array:
    """A kilogram each."""
    return np.ones(len(boxes))


def margin(boxes: Array, masses: Array | None = None, **settings: object) -> float:
    """The exact margin."""
    weights = ones(boxes) if masses is None else masses
    return StandingPile(boxes, weights, **settings).certificate().margin  # type: ignore[arg-type]


@st.composite
def piles(draw: st.DrawFn, most: int = 7) -> Array:
    """Boxes on a 10 cm grid, dropped on one another with their centres carried or not."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    boxes: list[tuple[float, ...]] = []
    for _ in range(draw(st.integers(1, most))):
        x, y = rng.integers(0, 4, 2)
        a, b, c = rng.integers(1, 4, 3)
        under = [
            o
            for o in boxes
            if x < o[0] + o[3] and o[0] < x + a and y < o[1] + o[4] and o[1] < y + b
        ]
        boxes.append((x, y, max((o[2] + o[5] for o in under), default=0), a, b, c))
    return prisms(*(tuple(float(value) / 10 for value in box) for box in boxes))  # type: ignore[arg-type]


@given(st.floats(0.1, 0.6), st.floats(0.1, 0.6), st.floats(0.1, 1.5))
def test_a_lone_box_tips_over_its_edge_or_slides(
    length: float, width: float, height: float
) -> None:
    """Whichever comes first: half its narrower side over half its height, or the friction."""
    expected = min(0.5, min(length, width) / height)
    found = margin(prisms((0, 0, 0, length, width, height)))
    assert found == pytest.approx(expected, abs=1e-6)


@settings(max_examples=20)
@given(st.floats(0.01, 0.39).filter(lambda out: abs(out - 0.2) > 1e-3))
def test_a_box_over_an_edge_falls_when_its_centre_is_out(out: float) -> None:
    """A 0.4 m box that hangs over another by some of its length."""
    pile = prisms((0, 0, 0, 0.4, 0.4, 0.2), (out, 0, 0.2, 0.4, 0.4, 0.2))
    found = StandingPile(pile, ones(pile)).certificate()
    assert found.stands == (out < 0.2)
    if out < 0.2:
        assert found.margin == pytest.approx(min(0.5, (0.2 - out) / 0.1), abs=1e-6)
    else:
        assert found.margin <= EDGE
        assert "does not stand at rest" in str(found)


@given(st.floats(0.2, 5.0).filter(lambda mass: abs(mass - 1.0) > 1e-3))
def test_a_counterweight_holds_a_box_that_hangs_over(mass: float) -> None:
    """A beam whose centre is 0.1 m out, with a small box on its other end, as far from the edge."""
    pile = prisms((0, 0, 0, 0.2, 0.2, 0.2), (0, 0, 0.2, 0.6, 0.2, 0.1), (0, 0, 0.3, 0.2, 0.2, 0.1))
    stands = StandingPile(pile, np.array([1.0, 1.0, mass])).certificate().stands
    assert stands == (mass > 1.0)


def test_a_bridge_falls_without_what_lies_on_its_end() -> None:
    """The certificate of a removal says who falls."""
    pile = prisms((0, 0, 0, 0.2, 0.2, 0.2), (0, 0, 0.2, 0.6, 0.2, 0.1), (0, 0, 0.3, 0.2, 0.2, 0.1))
    names = (BoxId("foot"), BoxId("beam"), BoxId("load"))
    standing = StandingPile(pile, np.array([1.0, 1.0, 3.0]), names=names)
    assert standing.certificate().stands
    left = standing.certificate([2], at_least=0.03)
    assert left.margin < 0
    assert left.proof is Proof.EXACT
    assert standing.certificate([0, 1, 2]).limiting == ()
    assert left.limiting == ("beam",)


@given(piles())
def test_forces_from_the_top_never_promise_more_than_there_is(pile: Array) -> None:
    """The quick bound is below the linear program's margin, whatever is asked for."""
    standing = StandingPile(pile, ones(pile))
    exact = standing.certificate()
    assert exact.proof is Proof.EXACT
    assert standing.quick_bound() <= exact.margin + 1e-6
    for enough in (0.0, 0.03, 0.2):
        bound = standing.certificate(at_least=enough)
        assert (bound.margin >= enough) == (exact.margin >= enough - 1e-7) or math.isclose(
            exact.margin, enough, abs_tol=1e-6
        )
        assert bound.margin <= exact.margin + 1e-6
        assert bound.proof is (Proof.AT_LEAST if bound.margin >= enough else Proof.EXACT)


@settings(max_examples=20)
@given(piles(), st.floats(0.1, 10), st.integers(0, 2**32 - 1))
def test_units_and_order_of_the_boxes_do_not_matter(pile: Array, scale: float, seed: int) -> None:
    """Masses in other units, rows in another order."""
    order = np.random.default_rng(seed).permutation(len(pile))
    masses = np.linspace(1, 2, len(pile))
    found = margin(pile, masses)
    assert margin(pile[order], scale * masses[order]) == pytest.approx(found, abs=1e-6)


@settings(max_examples=20)
@given(piles())
def test_a_turned_pile_stands_as_firmly(pile: Array) -> None:
    """By a quarter turn: lengths become widths."""
    turned = pile.copy()
    turned[:, 0], turned[:, 1] = -pile[:, 1], pile[:, 0]
    turned[:, 3], turned[:, 4] = pile[:, 4], pile[:, 3]
    assert margin(turned) == pytest.approx(margin(pile), abs=1e-6)


@settings(max_examples=12)
@given(piles(5))
def test_more_friction_never_harms_and_doubt_never_helps(pile: Array) -> None:
    """Nor do smaller patches help."""
    believed = margin(pile)
    assert margin(pile, friction=Friction(0.5, 0.3)) >= believed - 1e-6
    assert margin(pile, friction=Friction(0.2)) <= believed + 1e-6
    assert margin(pile, shares=0.2) <= believed + 1e-6
    assert margin(pile, rule=TouchRule(1e-6, 1e-6, 1e-6, 0.01)) <= believed + 1e-6


def test_a_sheet_leans_on_its_neighbours() -> None:
    """Alone it tips at a tenth of g; between two blocks the blocks must slide or tip as well."""
    sheet = (0.4, 0.0, 0.0, 0.05, 0.4, 0.5)
    alone = margin(prisms(sheet))
    pile = prisms((0, 0, 0, 0.4, 0.4, 0.5), sheet, (0.45, 0, 0, 0.4, 0.4, 0.5))
    assert alone == pytest.approx(0.1, abs=1e-6)
    assert margin(pile) > 0.3


def test_a_box_that_only_friction_of_its_neighbours_holds_falls() -> None:
    """It has nothing below; with friction at the side faces the program would hold it."""
    pile = prisms(
        (0, 0, 0, 0.4, 0.4, 0.5), (0.4, 0, 0.1, 0.2, 0.4, 0.3), (0.6, 0, 0, 0.4, 0.4, 0.5)
    )
    hanging = StandingPile(pile, ones(pile))
    assert hanging.assumed == ("1",)  # nothing seen below: taken as carried
    # On the edge of a foot, beside one heavy neighbour: only its friction could hold the box up.
    beside = prisms(
        (0, 0, 0, 0.4, 0.4, 0.5), (0.4, 0, 0.2, 0.2, 0.4, 0.3), (0.4, 0, 0, 0.05, 0.4, 0.2)
    )
    masses = np.array([90.0, 1.0, 1.0])
    assert margin(beside, masses) < 0
    held = prisms(
        (0, 0, 0, 0.4, 0.4, 0.5),
        (0.4, 0, 0.2, 0.2, 0.4, 0.3),
        (0.6, 0, 0, 0.4, 0.4, 0.5),
        (0.45, 0.0, 0, 0.1, 0.02, 0.2),
    )
    masses = np.array([90.0, 1.0, 90.0, 1.0])
    assert margin(held, masses) < 0
    assert margin(held, masses, friction=Friction(0.5, 0.5)) > 0


@pytest.mark.parametrize("yaw", [0.0, 0.3, 0.7, -0.4])
def test_a_turned_box_stands_on_the_corners_of_the_overlap(yaw: float) -> None:
    """A box turned on a larger one tips over its own nearest side, at most."""
    top = OrientedBox.upright((0, 0, 0.35), (0.2, 0.3, 0.5), yaw)
    pile = prisms_of([OrientedBox.upright((0, 0, 0.05), (0.6, 0.6, 0.1)), top])
    lowest = 0.2 / 0.5  # half its narrower side over half its height, pushed square to it
    found = margin(pile)
    assert lowest - 1e-6 <= found <= 0.5
    if yaw == 0.0:
        assert found == pytest.approx(lowest, abs=1e-6)


@pytest.mark.parametrize("yaw", [0.0, 0.001, 0.02, 0.6, -0.6])
def test_boxes_lean_face_to_face_and_corner_to_face(yaw: float) -> None:
    """A slim box stands firmer towards a neighbour that it touches, turned or not."""
    slim = OrientedBox.upright((0, 0, 0.3), (0.1, 0.1, 0.6))
    c, s = math.cos(yaw), math.sin(abs(yaw))
    aside = 0.0 if yaw == 0.0 else -math.copysign(0.2 * (c - s), yaw)
    big = OrientedBox.upright((0.05 + 0.2 * (c + s), aside, 0.3), (0.4, 0.4, 0.6), yaw)
    pile = prisms_of([slim, big])
    standing = StandingPile(pile, np.array([1.0, 20.0]), rule=TouchRule(1e-6, 1e-3, 1e-3))
    assert standing.certificate().margin == pytest.approx(0.1 / 0.6, abs=1e-6)
    pushed = standing.certificate()
    assert pushed.direction != (1.0, 0.0)  # there the neighbour helps


@settings(max_examples=6)
@given(piles(4))
def test_the_worst_of_a_set_is_no_better_than_what_is_believed(pile: Array) -> None:
    """With poses from a camera; asked for enough or for all."""
    believed = StandingPile(pile, ones(pile), rule=SEEN).certificate()
    doubted = StandingPile(pile, ones(pile), rule=SEEN, shares=0.3, doubt=CAMERA)
    worst = doubted.certificate()
    assert worst.cases == 1 + 5 + CAMERA.draws
    assert worst.margin <= believed.margin + 1e-6
    enough = doubted.certificate(at_least=0.05)
    if enough.proof is Proof.AT_MOST:
        assert worst.margin <= enough.margin + 1e-6 < 0.05
    else:
        assert enough.margin <= worst.margin + 1e-6


def test_one_case_that_falls_short_is_enough_to_refuse() -> None:
    """The rest of the set is not looked at: the margin is at most what was found."""
    pile = prisms((0, 0, 0, 0.4, 0.4, 0.2), (0.19, 0, 0.2, 0.4, 0.4, 0.2))
    sure = StandingPile(pile, ones(pile)).certificate(at_least=0.03)
    assert sure.proof is Proof.AT_LEAST
    doubted = StandingPile(pile, ones(pile), rule=SEEN, doubt=Doubt(pose=0.02, draws=8))
    found = doubted.certificate(at_least=0.2)
    assert found.proof is Proof.AT_MOST
    assert found.margin < 0.2
    assert "worst of 9 cases: lot" in str(found)


def test_many_boxes_find_room_for_all_their_contacts() -> None:
    """Layers of bricks, each on four others."""
    bricks = [
        (0.1 * i + 0.05 * (layer % 2), 0.1 * j + 0.05 * (layer % 2), 0.1 * layer, 0.1, 0.1, 0.1)
        for layer in range(6)
        for i in range(4)
        for j in range(4)
    ]
    standing = StandingPile(prisms(*bricks), np.ones(len(bricks)), rule=TouchRule(1e-6, 1e-6, 1e-6))
    assert standing.certificate([0]).margin < standing.friction.under


def test_a_patch_smaller_than_the_doubt_carries_nothing() -> None:
    """A sheet that is thinner than what its place is in doubt."""
    pile = prisms((0, 0, 0, 0.008, 0.4, 0.2))
    found = StandingPile(pile, ones(pile), rule=TouchRule(1e-6, 1e-6, 1e-6, 0.005)).certificate()
    assert found.margin == LEAST


@pytest.mark.parametrize(
    ("case", "order", "push", "falls"),
    [
        ("stands", [1, 0], 0.2, -1),
        ("slips", [1, 0], 0.6, 1),
        ("looked at in a wrong order", [0, 1], 0.0, 1),
    ],
)
def test_the_quick_pass_says_who_falls_first(
    case: str, order: list[int], push: float, falls: int
) -> None:
    """Two flat boxes, one on the other."""
    pile = prisms((0, 0, 0, 0.4, 0.4, 0.1), (0, 0, 0.1, 0.4, 0.4, 0.1))
    body = Body.of(pile, ones(pile), touches_of(pile, KNOWN, 0.0, np.empty(0, np.int32)))
    shuffled = replace(body, order=np.array(order, np.int32))
    assert shuffled.falling((1.0, 0.0), push, 0.5) == falls, case
    nothing = body.only(np.array([False, True]))
    assert nothing.falling((1.0, 0.0), 0.0, 0.5) == 1


def test_parts_that_a_removal_does_not_touch_are_not_solved_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Two piles apart: taking from one asks for the other once only."""
    solved: list[int] = []
    solver = program_module.linprog

    def counted(*words: object, **options: object) -> object:
        solved.append(1)
        return solver(*words, **options)

    monkeypatch.setattr(program_module, "linprog", counted)
    beam = [(0.0, 0.0, 0.0, 0.2, 0.2, 0.2), (0.0, 0.0, 0.2, 0.5, 0.2, 0.1)]
    other = [(2.0 + x, y, z, a, b, c) for x, y, z, a, b, c in beam]
    loads = [(x, 0.0, 0.3, 0.1, 0.2, 0.2) for x in (0.0, 2.0)]
    pile = prisms(*beam, *other, *loads)  # type: ignore[arg-type]
    standing = StandingPile(pile, np.array([1.0, 1, 1, 1, 9, 9]))
    standing.certificate()
    first = len(solved)
    standing.certificate([4])
    assert first == 2 * 4
    assert len(solved) == first + 4


def test_a_program_that_is_not_solved_leaves_the_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """The solver gives up: what was found box by box still holds."""

    class GaveUp:
        status = 1

    monkeypatch.setattr(program_module, "linprog", lambda *_, **__: GaveUp())
    pile = prisms((0, 0, 0, 0.1, 0.4, 0.5))
    found = StandingPile(pile, ones(pile)).certificate()
    assert found.proof is Proof.AT_LEAST
    assert 0.19 < found.margin <= 0.2
    fallen = prisms((0, 0, 0, 0.4, 0.4, 0.2), (0.3, 0, 0.2, 0.4, 0.4, 0.2))
    assert StandingPile(fallen, ones(fallen)).certificate().margin == LEAST


def test_masses_come_from_the_note_or_from_the_size() -> None:
    """A recognised box weighs what its product does; others are a guess with a wide doubt."""
    product = Product(Gtin("1"), "tea", (0.2, 0.2, 0.2), 3.0)
    shape = OrientedBox.from_corner((0, 0, 0), (0.2, 0.2, 0.2))
    boxes = (
        Recognition(BoxId("a"), shape, Gtin("1")),
        Recognition(BoxId("b"), shape, Gtin("2")),
        Detection(BoxId("c"), shape),
    )
    masses, shares = weigh(boxes, prisms_of([shape] * 3), {Gtin("1"): product})
    assert masses.tolist() == pytest.approx([3.0, 2.8, 2.8])
    assert shares[0] < shares[1] == shares[2] < 1


def test_no_boxes_cannot_fall() -> None:
    """An empty pallet has the friction's margin."""
    assert StandingPile(np.empty((0, 8)), np.empty(0)).certificate().margin == 0.5


@pytest.mark.parametrize(
    ("boxes", "mass", "message"),
    [
        (((0, 0, 0, 0.1, 0.1, math.nan),), 1.0, "box 0 has no place or no size"),
        (((0, 0, 0, 0.1, 0.1, 0.1),), 0.0, r"box 0 weighs .*masses above 0 kg"),
        (((0, 0, 0, 0.1, 0.1, 0.1),), math.inf, r"box 0 weighs"),
    ],
)
def test_what_is_no_pile_is_refused(
    boxes: tuple[tuple[float, float, float, float, float, float], ...], mass: float, message: str
) -> None:
    """With what is wrong."""
    with pytest.raises(PileError, match=message):
        StandingPile(prisms(*boxes), np.full(len(boxes), mass))


@pytest.mark.parametrize("value", [-1e-3, math.nan, math.inf])
def test_lengths_must_be_lengths(value: float) -> None:
    """Of rules and of doubts."""
    with pytest.raises(SettingError, match=r"contact gap: .* expected a length of 0 m"):
        TouchRule(0.0, value, 0.0)
    with pytest.raises(SettingError, match=r"doubt pose: .* expected a length of 0 m"):
        Doubt(pose=value)
    with pytest.raises(SettingError, match=r"doubt draws: -1"):
        Doubt(draws=-1)


def test_a_certificate_says_what_it_knows() -> None:
    """In one line."""
    seen = Certificate(0.12, Proof.AT_LEAST, (-1.0, 0.0), (BoxId("b3"),), 9, "heavy above")
    assert str(seen) == (
        "margin at least 0.120 g towards -x, limited by b3 (worst of 9 cases: heavy above)"
    )
    assert seen.stands
    most = Certificate(0.02, Proof.AT_MOST, (0.0, 1.0), ())
    assert str(most) == "margin at most 0.020 g towards +y"
    assert not most.stands
