"""Every mistake that a delivery as JSON can hold, and the words for it."""

import json
from collections.abc import Callable
from typing import Any

import pytest

Raw = dict[str, Any]
Complaint = Callable[..., str]

GONE = object()
"""Stands for a key that is taken out."""

NAME = "the delivery's name, unique in its file"
SIDE = "metres, from 0.001 to 2.5"
MASS = "mass of one full case [kg], above 0 and at most 1000"
COUNT = "how many cases of the product came, a whole number from 1 to 10000"
DIGITS = "8, 12, 13 or 14 digits"
ON_PALLET = "x in 0..1.2, y in 0..0.8 and z >= 0 m"
CARRIED = "a case whose top is there, or z = 0"
ZEROS = "which loses leading zeros: put it in quotes"

MISTAKES: list[tuple[str, object, str]] = [
    ("id", 7, f"id: 7 is a number, {ZEROS}; expected {NAME}"),
    ("id", "  ", f"id: is empty; expected {NAME}"),
    ("id", "a\nb", rf"id: 'a\nb' holds a line break or a control character; expected {NAME}"),
    ("id", "\ud800", rf"id: '\ud800' holds a line break or a control character; expected {NAME}"),
    ("id", GONE, f"id: is missing; expected {NAME}"),
    ("pallet", GONE, "pallet: is missing; expected the pallet that the cases stand on"),
    (
        "pallet",
        [1.2, 0.8, 0.144],
        "pallet: a list is not an object; expected the pallet that the cases stand on",
    ),
    ("pallet.size", [1.2, 0.8], "pallet.size: has 2 numbers; expected 3 of them"),
    (
        "pallet.size.2",
        144,
        f"pallet.size[2]: 144 is above 2.5 m: centimetres or millimetres?; expected {SIDE}",
    ),
    ("date", "today", "date: unknown key; there is: id, lines, pallet, stack"),
    ("stak", [], "stak: unknown key; did you mean 'stack'?"),
    ("a b", 1, "['a b']: unknown key; there is: id, lines, pallet, stack"),
    (
        "lines",
        {},
        "lines: an object is not a list; expected the note: a list with one line per product",
    ),
    ("lines", [], "lines: has no lines; expected 1 to 10000 of them"),
    (
        "lines.0",
        "tea",
        (
            "lines[0]: 'tea' is text, not an object; "
            "expected one line of the note: how many cases of which product"
        ),
    ),
    ("lines.1.mass", GONE, f"lines[1].mass: is missing; expected {MASS}"),
    (
        "lines.1.colour",
        "red",
        "lines[1].colour: unknown key; there is: count, gtin, mass, name, size",
    ),
    ("lines.1.counts", 1, "lines[1].counts: unknown key; did you mean 'count'?"),
    ("lines.1.mass", "0.3", f"lines[1].mass: '0.3' is text, not a number; expected {MASS}"),
    ("lines.1.mass", "", f"lines[1].mass: is empty; expected {MASS}"),
    ("lines.1.mass", 0, f"lines[1].mass: 0 is not positive; expected {MASS}"),
    ("lines.1.mass", -1.5, f"lines[1].mass: -1.5 is not positive; expected {MASS}"),
    ("lines.1.mass", 5399, f"lines[1].mass: 5399 is above 1000 kg: grams?; expected {MASS}"),
    ("lines.1.mass", True, f"lines[1].mass: true is not a number; expected {MASS}"),
    ("lines.1.mass", None, f"lines[1].mass: null is not a number; expected {MASS}"),
    ("lines.1.mass", [8], f"lines[1].mass: a list is not a number; expected {MASS}"),
    ("lines.1.mass", float("nan"), f"lines[1].mass: NaN is not a finite number; expected {MASS}"),
    (
        "lines.1.mass",
        float("-inf"),
        f"lines[1].mass: -Infinity is not a finite number; expected {MASS}",
    ),
    (
        "lines.1.mass",
        10**400,
        f"lines[1].mass: Infinity is not a finite number; expected {MASS}",
    ),
    ("lines.1.count", True, f"lines[1].count: true is not a whole number; expected {COUNT}"),
    ("lines.1.count", 1.0, f"lines[1].count: 1.0 is not a whole number; expected {COUNT}"),
    ("lines.1.count", 0, f"lines[1].count: 0 is not positive; expected {COUNT}"),
    ("lines.1.count", -3, f"lines[1].count: -3 is not positive; expected {COUNT}"),
    ("lines.1.count", 10001, f"lines[1].count: 10001 is above 10000; expected {COUNT}"),
    ("lines.0.size", [0.4], "lines[0].size: has 1 number; expected 3 of them"),
    ("lines.0.size", [0.4, 0.3, 0.2, 1], "lines[0].size: has 4 numbers; expected 3 of them"),
    (
        "lines.0.size",
        0.4,
        (
            "lines[0].size: 0.4 is not a list; "
            "expected length, width and height of a case standing upright [m]"
        ),
    ),
    (
        "lines.0.size.0",
        400,
        f"lines[0].size[0]: 400 is above 2.5 m: millimetres?; expected {SIDE}",
    ),
    ("lines.0.size.2", 0, f"lines[0].size[2]: 0 is not positive; expected {SIDE}"),
    (
        "lines.0.size.2",
        0.0004,
        f"lines[0].size[2]: 0.0004 m is less than a millimetre; expected {SIDE}",
    ),
    ("lines.0.name", "", "lines[0].name: is empty; expected what people call the product"),
    (
        "lines.0.gtin",
        12000823098180,
        (
            f"lines[0].gtin: 12000823098180 is a number, {ZEROS}; "
            "expected the case's trade item number in quotes, with its check digit"
        ),
    ),
    (
        "lines.0.gtin",
        "12000823098181",
        (
            "lines[0].gtin: '12000823098181' ends in the wrong check digit 1; "
            "expected 0, as in 12000823098180"
        ),
    ),
    ("lines.0.gtin", "1", f"lines[0].gtin: '1' has 1 digit; expected {DIGITS}"),
    ("lines.0.gtin", "1" * 15, f"lines[0].gtin: '{'1' * 15}' has 15 digits; expected {DIGITS}"),
    (
        "lines.0.gtin",
        "614141000",
        f"lines[0].gtin: '614141000' has 9 digits; expected {DIGITS}",
    ),
    (
        "lines.0.gtin",
        "36000291452",
        (
            f"lines[0].gtin: '36000291452' has 11 digits; expected {DIGITS}; "
            "with its leading zeros it would be 036000291452"
        ),
    ),
    ("lines.0.gtin", "tea", f"lines[0].gtin: 'tea' is not made of digits alone; expected {DIGITS}"),
    ("lines.0.gtin", "", f"lines[0].gtin: is empty; expected {DIGITS}"),
    (
        "lines.0.gtin",
        "1.20E+13",
        (
            "lines[0].gtin: '1.20E+13' was rounded by a spreadsheet; "
            f"expected {DIGITS}, from a column formatted as text"
        ),
    ),
    (
        "lines.0.count",
        3,
        (
            "lines[0].count: the note says 3, the stack has 2 of '12000823098180'; "
            "expected as many in both"
        ),
    ),
    (
        "lines.0.count",
        1,
        (
            "lines[0].count: the note says 1, the stack has 2 of '12000823098180'; "
            "expected as many in both"
        ),
    ),
    (
        "stack.2.size",
        [0.3, 0.25, 0.1],
        (
            "stack[2].size: 0.3 x 0.25 x 0.1 m is no turn of the product; "
            "expected 0.3 x 0.3 x 0.1 m in any order, within 1 mm"
        ),
    ),
    (
        "stack",
        None,
        (
            "stack: null is not a list; expected a list with every case's place on the pallet, "
            "in any order; left out where only the note is known"
        ),
    ),
    ("stack", [], "stack: has no cases; expected 1 to 10000 of them"),
    (
        "stack.2.gtin",
        "12000807013119",
        (
            "stack[2].gtin: '12000807013119' ends in the wrong check digit 9; "
            "expected 6, as in 12000807013116"
        ),
    ),
    (
        "stack.2.corner",
        GONE,
        (
            "stack[2].corner: is missing; expected x, y, z of the corner with the smallest "
            "coordinates, in the pallet's frame: x along its length, y along its width, "
            "z up from the deck [m]"
        ),
    ),
    ("stack.2.corner", [0, 0], "stack[2].corner: has 2 numbers; expected 3 of them"),
    (
        "stack.1.corner.0",
        400,
        "stack[1].corner[0]: 400 is beyond 10 m: millimetres?; expected metres",
    ),
    (
        "stack.1.corner.0",
        1.0,
        f"stack[1]: is not on the pallet: reaches to x = 1.3 m; expected {ON_PALLET}",
    ),
    (
        "stack.1.corner.1",
        -0.002,
        f"stack[1]: is not on the pallet: reaches to y = -0.002 m; expected {ON_PALLET}",
    ),
    (
        "stack.1.corner",
        [0.4, 0.5, -0.01],
        f"stack[1]: is not on the pallet: reaches to z = -0.01 m, y = 0.9 m; expected {ON_PALLET}",
    ),
    (
        "stack.1.corner.0",
        0.35,
        "stack[0]: overlaps stack[1] by 50 mm; expected cases that share no space",
    ),
    (
        "stack.2.corner.2",
        0.25,
        f"stack[2]: floats: nothing ends under its bottom at z = 0.25 m; expected {CARRIED}",
    ),
    (
        "stack.2.corner.1",
        0.4,
        f"stack[2]: floats: nothing ends under its bottom at z = 0.2 m; expected {CARRIED}",
    ),
]


def damage(raw: Raw, path: str, value: object) -> None:
    """Puts a value, or a gap, in the place of what is at a dotted path."""
    node: Any = raw
    *outer, last = (int(step) if step.isdigit() else step for step in path.split("."))
    for step in outer:
        node = node[step]
    if value is GONE:
        del node[last]
    else:
        node[last] = value


@pytest.mark.parametrize(
    ("path", "value", "message"), MISTAKES, ids=[message[:40] for *_, message in MISTAKES]
)
def test_a_single_mistake_gets_one_sentence(
    toy: Raw, complaint: Complaint, path: str, value: object, message: str
) -> None:
    """What, where, what was expected, what exists: pinned word for word."""
    damage(toy, path, value)
    assert complaint(json.dumps(toy)) == f"DeliveryError: in.json: {message}"


def test_a_product_on_two_lines_is_one_mistake_with_its_consequences(
    toy: Raw, tea: str, complaint: Complaint
) -> None:
    """The line, the counts and the product that is gone are all named."""
    damage(toy, "lines.1.gtin", tea)
    assert complaint(json.dumps(toy)).splitlines() == [
        "DeliveryError: in.json: 3 problems",
        f"  lines[0].count: the note says 3, the stack has 2 of '{tea}'; expected as many in both",
        f"  lines[1].gtin: '{tea}' is already on lines[0]; expected each product on one line",
        (
            "  stack[2].gtin: '12000807013116' is not on the note; expected a product of the note; "
            f"there is: {tea}"
        ),
    ]


def test_the_same_product_with_other_leading_zeros_is_the_same_product(
    toy: Raw, complaint: Complaint
) -> None:
    """GTIN-8, -12, -13 and -14 name one article when only zeros differ."""
    del toy["stack"]
    damage(toy, "lines.0.gtin", "96385074")
    damage(toy, "lines.1.gtin", "0000096385074")
    assert complaint(json.dumps(toy)) == (
        "DeliveryError: in.json: lines[1].gtin: '0000096385074' is already on lines[0]; "
        "expected each product on one line"
    )


def test_a_stacked_product_that_is_close_to_one_on_the_note_is_recognised(
    toy: Raw, tea: str, complaint: Complaint
) -> None:
    """A number that differs in its zeros alone gets a hint, and the list of what there is."""
    damage(toy, "stack.0.gtin", "12000823098197")
    assert complaint(json.dumps(toy)).splitlines() == [
        "DeliveryError: in.json: 2 problems",
        f"  lines[0].count: the note says 2, the stack has 1 of '{tea}'; expected as many in both",
        (
            "  stack[0].gtin: '12000823098197' is not on the note; expected a product of the note; "
            f"did you mean '{tea}'? (there is: 12000807013116, {tea})"
        ),
    ]


def test_mistakes_of_every_kind_are_reported_together(toy: Raw, complaint: Complaint) -> None:
    """One reading is enough to repair a file, in the order of the format."""
    for path, value in [
        ("colour", "red"),
        ("id", ""),
        ("lines.0.mass", "heavy"),
        ("lines.1.count", 2),
        ("stack.0.size.1", "wide"),
        ("stack.1.corner.0", 1.0),
        ("stack.2.corner.1", 0.7),
    ]:
        damage(toy, path, value)
    said = complaint(json.dumps(toy)).splitlines()
    assert [line.split(": ")[0].strip() for line in said[1:]] == [
        "id",
        "lines[0].mass",
        "lines[1].count",
        "stack[0].size[1]",
        "stack[1]",
        "stack[2]",
        "colour",
    ]


def test_cases_that_could_not_be_read_may_be_the_missing_ones(
    toy: Raw, complaint: Complaint
) -> None:
    """A mistake in a stacked product is not reported a second time as a wrong count."""
    damage(toy, "stack.0.gtin", GONE)
    damage(toy, "lines.1.count", 3)
    said = complaint(json.dumps(toy)).splitlines()
    assert [line.split(": ")[0].strip() for line in said[1:]] == ["lines[1].count", "stack[0].gtin"]


def test_a_case_of_unknown_size_must_still_stand_on_the_pallet(
    toy: Raw, complaint: Complaint
) -> None:
    """Its corner alone tells; what it may carry or overlap is left open."""
    damage(toy, "stack.0.size", "flat")
    damage(toy, "stack.0.corner.0", -0.3)
    said = complaint(json.dumps(toy)).splitlines()
    assert [line.split("; ")[0].strip() for line in said[1:]] == [
        "stack[0]: is not on the pallet: reaches to x = -0.3 m",
        "stack[0].size: 'flat' is text, not a list",
    ]


def test_a_case_that_overlaps_many_names_the_first_of_them(toy: Raw, complaint: Complaint) -> None:
    """The list of neighbours is cut, its length is not lost."""
    toy["stack"] = [dict(toy["stack"][0]) for _ in range(8)]
    damage(toy, "lines.0.count", 8)
    assert (
        "  stack[0]: overlaps stack[1] by 200 mm, stack[2] by 200 mm, stack[3] by 200 mm, "
        "stack[4] by 200 mm, stack[5] by 200 mm and 2 more; expected cases that share no space"
    ) in complaint(json.dumps(toy)).splitlines()


def test_in_a_list_every_problem_names_the_delivery(toy: Raw, complaint: Complaint) -> None:
    """By its index and, where it has one that can be printed, by its id."""
    nameless = {**toy, "id": 5}
    awkward = {**toy, "id": "a\nb"}
    heavy = {**toy, "id": "heavy", "lines": [{**toy["lines"][0], "mass": "x"}, toy["lines"][1]]}
    said = complaint(json.dumps([toy, nameless, awkward, heavy, "none", toy])).splitlines()
    assert said == [
        "DeliveryError: in.json: 5 problems",
        f"  [1].id: 5 is a number, {ZEROS}; expected {NAME}",
        rf"  [2].id: 'a\nb' holds a line break or a control character; expected {NAME}",
        f"  [3] heavy: lines[0].mass: 'x' is text, not a number; expected {MASS}",
        (
            "  [4]: 'none' is text, not an object; expected one delivery: the note, the pallet "
            "and, for simulation, how the cases stand on it"
        ),
        "  [5] toy: id: [0] has this id too; expected every id once in a file",
    ]


def test_a_long_list_of_problems_is_cut_and_counted(toy: Raw, complaint: Complaint) -> None:
    """The first fifty are printed, the total stands at both ends."""
    toy["lines"] = [{**toy["lines"][0], "gtin": str(number)} for number in range(170)]
    del toy["stack"]
    said = complaint(json.dumps(toy)).splitlines()
    assert said[0] == "DeliveryError: in.json: 170 problems"
    assert len(said) == 52
    assert said[-1] == "  and 120 more"
