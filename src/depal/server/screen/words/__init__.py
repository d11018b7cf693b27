"""What the screen says, in the language of whoever looks."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from depal.server.screen.words.english import ENGLISH
from depal.server.screen.words.italian import ITALIAN

CATALOGUES: Final[Mapping[str, Mapping[str, str]]] = MappingProxyType(
    {"en": ENGLISH, "it": ITALIAN}
)

NAMES: Final[Mapping[str, str]] = MappingProxyType({"en": "English", "it": "Italiano"})

FIRST = "en"
"""For those whose language nobody speaks here."""

Words = Callable[..., str]
"""Says what a key means: `words("now.start")`, `words("now.left", boxes=3)`."""


def words_of(language: str) -> Words:
    """The words of a language."""
    catalogue = CATALOGUES.get(language, ENGLISH)

    def say(key: str, **values: object) -> str:
        return catalogue[key].format(**values) if values else catalogue[key]

    return say


def place_name(place: str, words: Words) -> str:
    """A trolley's, a shelf's or a compartment's name, as people say it: `trolley_2/level_1`."""
    told = []
    for part in place.split("/"):
        kind, _, number = part.rpartition("_")
        known = kind in {"trolley", "level", "shelf"} and number.isdigit()
        plain = words("place.shelf_alone") if part == "shelf" else part.replace("_", " ")
        told.append(words(f"place.{kind}", number=number) if known else plain)
    return ", ".join(told)


def language_of(accepted: str) -> str:
    """The language of a browser.

    Args:
        accepted: its `Accept-Language` header, as in "it-IT,it;q=0.9,en;q=0.8".
    """
    ranked: list[tuple[float, int, str]] = []
    for place, part in enumerate(accepted.split(",")):
        name, _, weight = part.strip().partition(";q=")
        try:
            share = float(weight) if weight else 1.0
        except ValueError:
            continue
        ranked.append((-share, place, name.split("-")[0].lower()))
    known = (name for share, _, name in sorted(ranked) if name in CATALOGUES and share < 0)
    return next(known, FIRST)
