"""The catalogues: the same keys, the same gaps, and every text goes through them."""

import ast
import re
import string
from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.server.cellstate import Mode
from depal.server.screen.said import said_in
from depal.server.screen.words import CATALOGUES, FIRST, language_of, place_name, words_of

SOURCES = sorted(
    path
    for path in Path(str(files("depal.server.screen"))).rglob("*.py")
    if "words" not in path.parts or path.name == "__init__.py"
)


def gaps(text: str) -> set[str]:
    """The names in braces."""
    return {name for _, name, _, _ in string.Formatter().parse(text) if name}


def test_all_languages_have_the_same_keys() -> None:
    """All languages have the same keys."""
    keys = {language: set(catalogue) for language, catalogue in CATALOGUES.items()}
    assert keys["it"] == keys["en"]


@pytest.mark.parametrize("key", sorted(CATALOGUES["en"]))
def test_all_languages_have_the_same_gaps(key: str) -> None:
    """All languages have the same gaps."""
    assert gaps(CATALOGUES["it"][key]) == gaps(CATALOGUES["en"][key])


def keys_in_sources() -> tuple[set[str], set[str]]:
    """The keys that the screen uses, whole ones and beginnings of those with a gap."""
    whole, begun = set(), set()
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                if re.fullmatch(r"[a-z]+\.[a-z_]*[a-z]", node.value):
                    whole.add(node.value)
            elif isinstance(node, ast.JoinedStr) and isinstance(node.values[0], ast.Constant):
                start = str(node.values[0].value)
                if re.fullmatch(r"[a-z]+\.[a-z_]*", start):
                    begun.add(start)
    return whole, begun


def test_every_key_that_is_used_exists_and_every_key_is_used() -> None:
    """Every key that is used exists and every key is used."""
    whole, begun = keys_in_sources()
    known = set(CATALOGUES["en"])
    families = {key.split(".")[0] for key in known}
    assert {key for key in whole if key.split(".")[0] in families} - known == set()
    unused = {key for key in known - whole if not any(key.startswith(start) for start in begun)}
    assert unused == set()


@pytest.mark.parametrize("mode", list(Mode))
def test_every_mode_has_a_word(mode: Mode) -> None:
    """Every mode has a word."""
    assert all(catalogue[f"mode.{mode.value}"] for catalogue in CATALOGUES.values())


def test_the_browsers_first_known_language_is_spoken() -> None:
    """The browsers first known language is spoken."""
    assert language_of("it-IT,it;q=0.9,en;q=0.8") == "it"
    assert language_of("de-DE,en;q=0.7,it;q=0.8") == "it"
    assert language_of("de,fr;q=0.5") == FIRST
    assert language_of("it;q=0,en;q=0.1") == "en"
    assert language_of("") == FIRST


@given(st.text(max_size=60))
def test_no_header_breaks_the_choice_of_a_language(header: str) -> None:
    """No header breaks the choice of a language."""
    assert language_of(header) in CATALOGUES


def test_what_the_cell_says_is_said_in_italian_with_its_names() -> None:
    """What the cell says is said in italian with its names."""
    say = said_in("it")
    told = say("The arm cannot take box b7: b3 on top; b2 in front. Please take it off the pallet.")
    assert told == (
        "Il braccio non può prendere la scatola b7: b3 sopra; b2 davanti. Toglila dal pallet."
    )
    assert say("trolley_2 is full. Please pull it out and put an empty one into its bay.") == (
        "Il carrello 2 è pieno. Tiralo fuori e metti un carrello vuoto al suo posto."
    )


@given(st.text(max_size=80))
def test_what_is_not_known_in_italian_stays_as_it_is(text: str) -> None:
    """What is not known in italian stays as it is."""
    sentence = f"Zz {text}"
    assert said_in("en")(sentence).replace(" ", "_") == sentence.replace(" ", "_")


def test_a_name_with_braces_is_only_a_name() -> None:
    """A name with braces is only a name."""
    say = said_in("it")
    told = say("Box b1: {0.__class__} {box}. Please pick it up.")
    assert told == "Scatola b1: {0.__class__} {box}. Raccoglila."


def test_places_have_names_that_people_use() -> None:
    """Places have names that people use."""
    words = words_of("it")
    assert place_name("trolley_2/level_1", words) == "carrello 2, ripiano 1"
    assert place_name("shelf", words) == "scaffale"
    assert place_name("cold_room", words) == "cold room"
