"""Retrieval as a Gymnasium environment: the paper's rule and a random player on the same pallets.

pip install 'depal[gym]'; python examples/play_retrieval.py
"""

import gymnasium
import numpy as np

from depal.studies.gymnasium_env import ID, PalletEnv, register

EPISODES = 20

register()
env = gymnasium.make(ID, pallets="guillotine,layered,cubic,columns,dropped", requests=1)
pallets = env.unwrapped
assert isinstance(pallets, PalletEnv)  # noqa: S101 - what it is made of
rng = np.random.default_rng(0)


def random_box(mask: np.ndarray) -> int:
    """Any box that may be taken."""
    return int(rng.choice(np.flatnonzero(mask)))


def by_the_paper(_: np.ndarray) -> int:
    """Algorithm 1 at w = 0.9."""
    return pallets.game.by_the_paper(0.9)


for name, policy in (("paper, w = 0.9", by_the_paper), ("random", random_box)):
    actions = []
    for seed in range(EPISODES):
        _, info = env.reset(seed=seed)
        count, over = 0, False
        while not over:
            _, _, ended, cut, info = env.step(np.int64(policy(info["action_mask"])))
            count, over = count + 1, ended or cut
        actions.append(count - 1)
    print(f"{name}: {np.mean(actions):.1f} boxes before the requested one: {actions}")
