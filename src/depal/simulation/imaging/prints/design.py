"""How a product's case looks, drawn by lot from its number alone.

Numbers that begin alike belong to one range of one maker: their cases have the same artwork and
differ in a word and in one colour, which is what a recognition must cope with.
"""

import hashlib
from dataclasses import dataclass
from enum import Enum

import numpy as np

Colour = tuple[int, int, int]

FAMILY_DIGITS = 10
"""Products whose 14 digits begin with the same ten share their artwork."""

OWN = 4
"""A range has so many colours of its products' own; with words and amounts there are more looks
than the numbers of a range can have, so that no two of its products look the same."""

KRAFT: Colour = (193, 154, 107)
WHITE: Colour = (240, 238, 232)

# Ground, dark and light of a range; calm colours that cardboard is printed with.
_PALETTES: tuple[tuple[Colour, Colour, Colour], ...] = (
    ((46, 94, 138), (22, 48, 78), (226, 236, 242)),
    ((176, 58, 46), (92, 26, 22), (250, 236, 220)),
    ((62, 128, 92), (24, 66, 48), (236, 244, 226)),
    ((226, 168, 58), (110, 70, 20), (255, 248, 226)),
    ((118, 84, 140), (58, 38, 76), (240, 232, 246)),
    ((42, 132, 140), (14, 66, 74), (226, 246, 244)),
    ((206, 112, 62), (104, 46, 22), (255, 240, 226)),
    ((228, 224, 212), (60, 66, 78), (250, 250, 246)),
    ((74, 82, 96), (34, 38, 46), (232, 234, 238)),
    ((198, 92, 120), (98, 32, 54), (255, 236, 242)),
)
_ACCENTS: tuple[Colour, ...] = (
    (232, 192, 64),
    (214, 72, 58),
    (74, 156, 96),
    (68, 128, 196),
    (238, 138, 52),
    (148, 88, 164),
    (250, 250, 246),
    (52, 60, 72),
)
_BEGINNINGS = ("Nor", "Tel", "Bri", "Sal", "Kor", "Mei", "Ori", "Val", "Lum", "Fen", "Har", "Pal")
_ENDINGS = ("va", "mo", "sta", "lino", "dea", "rell", "tia", "kko", "bano", "nis", "fino", "ra")
_VARIETIES = (
    "Classic",
    "Mild",
    "Dark",
    "Fresh",
    "Rustic",
    "Light",
    "Golden",
    "Forte",
    "Garden",
    "Alpine",
    "Harvest",
    "Pure",
)
_COUNTS = ("6", "8", "10", "12", "20", "24")
_AMOUNTS = ("250 g", "400 g", "750 g", "1 kg")


class Stock(Enum):
    """What a case is made of and how much is printed on it."""

    GRAPHIC = "printed all over"
    PLAIN = "white with a name"
    KRAFT = "brown with a name"


class Motif(Enum):
    """The shapes of a range's artwork."""

    BAND = "band"
    HILLS = "hills"
    SUN = "sun"
    SLANT = "slant"
    DOTS = "dots"
    STRIPES = "stripes"


@dataclass(frozen=True, slots=True)
class Design:
    """How a case looks.

    Attributes:
        stock: of the whole range.
        motif: of the whole range.
        brand: the range's name.
        ground: colour of the range.
        dark: colour of the range's text on light ground.
        light: colour of the range's text on dark ground.
        accent: the product's own colour.
        variety: the product's own word.
        contents: the product's own amount.
        seed: of the range's arrangement.
    """

    stock: Stock
    motif: Motif
    brand: str
    ground: Colour
    dark: Colour
    light: Colour
    accent: Colour
    variety: str
    contents: str
    seed: int


def family_of(gtin: str) -> str:
    """What all products of one range share of their numbers."""
    return gtin.zfill(14)[:FAMILY_DIGITS]


def design_of(gtin: str) -> Design:
    """The look of a product's cases."""
    seed = _seed(family_of(gtin))
    family = np.random.default_rng(seed)
    stock = (Stock.GRAPHIC, Stock.PLAIN, Stock.KRAFT)[int(family.choice(3, p=(0.6, 0.15, 0.25)))]
    motif = tuple(Motif)[int(family.integers(len(Motif)))]
    ground, dark, light = _PALETTES[int(family.integers(len(_PALETTES)))]
    brand = _pick(family, _BEGINNINGS) + _pick(family, _ENDINGS)
    accents = family.permutation(len(_ACCENTS))
    looks = family.permutation(OWN * len(_VARIETIES) * len(_COUNTS) * len(_AMOUNTS))
    look = int(looks[int(gtin.zfill(14)[FAMILY_DIGITS:-1])])
    look, own = divmod(look, OWN)
    look, word = divmod(look, len(_VARIETIES))
    count, amount = divmod(look, len(_AMOUNTS))
    return Design(
        stock,
        motif,
        brand,
        ground,
        dark,
        light,
        _ACCENTS[int(accents[own])],
        _VARIETIES[word],
        f"{_COUNTS[count]} x {_AMOUNTS[amount]}",
        seed,
    )


def _pick(random: np.random.Generator, words: tuple[str, ...]) -> str:
    return words[int(random.integers(len(words)))]


def _seed(text: str) -> int:
    return int.from_bytes(hashlib.blake2b(text.encode(), digest_size=6).digest(), "big")
