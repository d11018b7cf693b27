"""The score is kept as a file, and learns what can be learned."""

import numpy as np
import pytest

from depal.perception.scoring import NAMES, FaceScore, shipped_score
from depal.studies.training.network import Schooling, trained


def test_a_score_is_the_same_after_it_was_kept() -> None:
    """To the digits that are written."""
    score = shipped_score()
    features = np.random.default_rng(0).normal(0.0, 1.0, (50, len(NAMES)))
    again = FaceScore.from_text(score.as_text())
    assert again.log_odds(features) == pytest.approx(score.log_odds(features), abs=1e-2)


def test_a_score_of_other_features_is_refused() -> None:
    """It would say anything."""
    text = shipped_score().as_text().replace("weakest side", "weakest slide")
    with pytest.raises(ValueError, match="train it again"):
        FaceScore.from_text(text)


def test_nothing_has_no_score() -> None:
    """An empty picture is no error."""
    assert shipped_score().log_odds(np.zeros((0, len(NAMES)))).shape == (0,)


def test_training_finds_what_separates() -> None:
    """A ring is none of the features, but their product."""
    random = np.random.default_rng(1)
    features = random.normal(0.0, 1.0, (4000, 3))
    faces = (np.hypot(features[:, 0], features[:, 1]) < 1.0).astype(float)
    score = trained(features, faces, random, Schooling(hidden=12, steps=1500, batch=512, rate=1e-2))
    right = (score.log_odds(features) > 0.0) == (faces > 0.0)
    assert right.mean() > 0.95
    same = trained(
        features, faces, np.random.default_rng(2), Schooling(hidden=4, steps=50, batch=64)
    )
    twin = trained(
        features, faces, np.random.default_rng(2), Schooling(hidden=4, steps=50, batch=64)
    )
    assert np.array_equal(same.first, twin.first)
