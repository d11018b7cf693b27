"""Laws of the colours of a print's areas."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from printed_faces import A, book_of_drawings, face_of, lit

from depal.perception.recognition.patches import Patch
from depal.perception.recognition.prints import COARSE, print_of
from depal.perception.recognition.registration import Motion, brought_back, registered
from depal.perception.recognition.tones import areas_of, tones
from depal.simulation.imaging.prints import design_of

PICTURE = book_of_drawings(A).entries[A.gtin].faces["top"]
PRINT = print_of(A, "top", PICTURE)
gains = st.tuples(*[st.floats(0.7, 1.0)] * 3)


def told(patch: Patch) -> tuple[float, float, float, float]:
    """What the colours of a face say against the print."""
    seen = patch.features
    back = brought_back(
        seen, registered(seen, PRINT.levels[1], Motion()), PRINT.levels[0].weights.shape
    )
    usual, first, second, bright = np.exp(
        tones(back.thinned(COARSE), PRINT.coarse, PRINT.areas)
    ).tolist()
    return usual, first, second, bright


def recoloured(patch: Patch) -> Patch:
    """The same face whose own colour is another one."""
    accent = np.array(design_of(A.gtin).accent, dtype=float)
    own = np.abs(patch.colour.astype(float) - accent).max(axis=2) < 30
    colour = patch.colour.copy()
    colour[own] = np.clip(accent * (1.0, 0.72, 1.0), 0, 255).astype(np.uint8)
    return replace(patch, colour=colour)


@given(gains)
@settings(max_examples=15, deadline=None)
def test_light_changes_no_area(light: tuple[float, float, float]) -> None:
    """Whatever its colour."""
    _, first, second, _ = told(lit(face_of(A, "top"), light))
    assert first < 0.07
    assert second <= first


@given(gains)
@settings(max_examples=15, deadline=None)
def test_another_colour_is_seen_under_any_light(light: tuple[float, float, float]) -> None:
    """Be it only a little less green."""
    assert told(lit(recoloured(face_of(A, "top")), light))[1] > 0.15


@given(st.floats(0.1, 0.7))
@settings(max_examples=10, deadline=None)
def test_tape_on_a_part_of_a_face_changes_no_area(where: float) -> None:
    """Because medians are compared."""
    patch = face_of(A, "top")
    colour = patch.colour.astype(float)
    left = round(where * colour.shape[1])
    strip = slice(left, left + round(0.02 / patch.step))
    colour[:, strip] = 0.4 * colour[:, strip] + 0.6 * np.array((206, 184, 140))
    taped = replace(patch, colour=colour.astype(np.uint8))
    assert told(taped)[1] == pytest.approx(told(patch)[1], abs=0.06)


def test_a_print_is_taken_apart_into_its_colours() -> None:
    """Ground, ring and disc, at least; letters are too small to be areas."""
    areas = areas_of(PRINT.coarse)
    shares = [float((areas.label == k).mean()) for k in range(areas.count)]
    assert sum(share > 0.05 for share in shares) >= 3
    assert (areas.label[PRINT.coarse.weights == 0.0] == -1).all()
