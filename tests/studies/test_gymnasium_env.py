"""`depal/Pallet-v0`: what Gymnasium asks of an environment, and what it plays."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from depal.errors import SettingError
from depal.studies.case1 import count_trial, draw_trial
from depal.studies.gymnasium_env import ID, PalletEnv, register
from depal.studies.pallets import GENERATORS
from depal.studies.retrieval_game import Blocking, PalletGame, Pile, Setting


def played(env: PalletEnv, w: float, seed: int) -> float:
    """The return of Algorithm 1."""
    env.reset(seed=seed)
    total, ended = 0.0, False
    while not ended:
        _, reward, ended, _, info = env.step(np.int64(env.game.by_the_paper(w)))
        assert not info["refused"]
        total += reward
    return total


@pytest.mark.parametrize("pallets", [",".join(GENERATORS), "real"])
def test_gymnasium_finds_nothing_to_complain_about(pallets: str) -> None:
    """Its own checker, every warning an error."""
    register()
    register()
    env = gymnasium.make(ID, pallets=pallets, requests=2, render_mode="ansi")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)


def test_the_return_of_the_papers_rule_is_minus_table_1s_count() -> None:
    """On the same pallet, by the study's own compiled loop."""
    for seed in range(6):
        trial = draw_trial(GENERATORS["guillotine"], 0, seed)
        priorities = np.zeros(len(trial.pallet))
        priorities[trial.requested] = trial.priority
        game = PalletGame(Pile.of(trial.pallet, "guillotine"), priorities)
        total, ended = 0.0, False
        while not ended:
            taken = game.take(game.by_the_paper(0.9))
            total, ended = total + taken.reward, taken.ended
        assert -total == count_trial(trial, [0.9])[5]


def test_the_same_seed_is_the_same_episode() -> None:
    """Another one is not."""
    env = PalletEnv(pallets="dropped,real", requests=3)
    one, again, other = (env.reset(seed=seed)[0]["boxes"] for seed in (4, 4, 5))
    assert (one == again).all()
    assert not (one == other).all()


def test_a_request_pulls_and_access_needs_fewer_actions_than_the_papers_rule() -> None:
    """Over some pallets, w = 0.9 beats w = 0; what the mask says is what can be done."""
    env = PalletEnv(pallets="guillotine")
    returns = [[played(env, w, seed) for seed in range(10)] for w in (0.0, 0.9)]
    assert np.mean(returns[1]) > np.mean(returns[0])
    for kind in (*GENERATORS, "real"):
        for seed in range(3):
            paper = PalletGame.drawn(Setting((kind,)), np.random.default_rng(seed))
            access = PalletGame.drawn(
                Setting((kind,), blocking=Blocking.ACCESS), np.random.default_rng(seed)
            )
            while not (taken := paper.take(paper.by_the_paper(0.9))).ended:
                assert not taken.refused
                assert (access.takeable()).any()
            assert access.takeable().sum() >= 1


def test_what_may_be_taken_under_g_may_be_taken_by_access() -> None:
    """Fewer boxes are blocked per direction than by both at once."""
    for kind in GENERATORS:
        paper = PalletGame.drawn(Setting((kind,)), np.random.default_rng(1))
        access = PalletGame.drawn(
            Setting((kind,), blocking=Blocking.ACCESS), np.random.default_rng(1)
        )
        assert (access.takeable() | ~paper.takeable()).all()


def test_a_box_that_may_not_be_taken_stays_and_costs() -> None:
    """Nor one that does not exist."""
    env = PalletEnv(pallets="guillotine", render_mode="ansi")
    observation, info = env.reset(seed=1)
    blocked = int(np.flatnonzero(observation["takeable"] == 0)[0])
    after, reward, ended, truncated, told = env.step(np.int64(blocked))
    assert (after["boxes"] == observation["boxes"]).all()
    assert (reward, ended, truncated, told["refused"]) == (-1.0, False, False, True)
    assert (info["action_mask"] == observation["takeable"]).all()
    text = env.render()
    assert text is not None
    assert "wanted, p = " in text
    assert PalletEnv(pallets="cubic").render() is None


def test_what_cannot_be_played_is_refused() -> None:
    """With what can."""
    with pytest.raises(SettingError, match="unknown name 'gillotine'; did you mean 'guillotine'"):
        PalletEnv(pallets="gillotine")
    with pytest.raises(SettingError, match="requests: 0 boxes are wanted; expected 1 or more"):
        PalletEnv(requests=0)
    with pytest.raises(SettingError, match="pallets: no name"):
        Setting(pallets=())
    with pytest.raises(ValueError, match="'best' is not a valid Blocking"):
        PalletEnv(blocking="best")
