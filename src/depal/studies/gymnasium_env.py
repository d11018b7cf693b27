"""`depal/Pallet-v0`: retrieval as a Gymnasium environment (the optional extra `gym`).

    from depal.studies.gymnasium_env import register
    register()
    env = gymnasium.make("depal/Pallet-v0", pallets="guillotine,dropped", requests=1)

Observation, a dictionary:
    boxes: (most, 7) x, y, z of the centre and the edges [m] in the cell frame, p of the open
        request for it or 0; rows of zeros for what has left and for rows that are not used.
    takeable: (most,) 1 for the boxes that may be taken now: the mask of the actions; also as
        `info["action_mask"]`.
Action: the row of the box to take. What may not be taken stays, and costs as much as another box.
Reward: minus the requests that are still open after the action, so that an episode's return is
    minus the boxes taken before each requested one: with one request, Table I's count.
End: every request is served (terminated), or 1,000 actions (truncated).
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from depal.errors import MissingPartError
from depal.logistics import shipped_deliveries
from depal.studies.pallets import COUNTS, GENERATORS
from depal.studies.retrieval_game import REAL, Blocking, PalletGame, Setting

try:
    import gymnasium
    from gymnasium import spaces
except ImportError as error:
    message = "Gymnasium is not installed; pip install 'depal[gym]'"
    raise MissingPartError(message) from error

ID = "depal/Pallet-v0"
"""By what `gymnasium.make` knows it, once `register` was called."""

LONGEST = 1_000
"""Actions after which an episode is cut off."""

LOW = (0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0)
HIGH = (4.0, 2.0, 4.0, 2.5, 2.5, 2.5, 1.0)
"""Of each feature of a box."""

Observation = dict[str, npt.NDArray[Any]]


def register() -> None:
    """Makes `depal/Pallet-v0` known to Gymnasium; may be called twice."""
    if ID not in gymnasium.registry:
        gymnasium.register(ID, f"{__name__}:PalletEnv", max_episode_steps=LONGEST)


class PalletEnv(gymnasium.Env[Observation, np.int64]):
    """See the module."""

    metadata = {"render_modes": ["ansi"], "render_fps": 1}  # noqa: RUF012 - as Gymnasium has it

    def __init__(
        self,
        pallets: str = ",".join(GENERATORS),
        requests: int = 1,
        blocking: str = "paper",
        render_mode: str | None = None,
    ) -> None:
        """What is played.

        Args:
            pallets: names of generators with commas between them, or `real`.
            requests: how many boxes are wanted.
            blocking: "paper": leaves of G may be taken; "access": what is free above, or above
                and before.
            render_mode: "ansi" for text, or None.

        Raises:
            SettingError: a name or a number that does not exist.
            ValueError: unknown blocking.
        """
        names = tuple(name.strip() for name in pallets.split(","))
        self.setting = Setting(names, requests, Blocking(blocking))
        self.render_mode = render_mode
        most = max(_most(name) for name in names)
        low, high = (np.tile(np.array(end, np.float32), (most, 1)) for end in (LOW, HIGH))
        self.observation_space: spaces.Dict = spaces.Dict(  # type: ignore[assignment]
            {"boxes": spaces.Box(low, high, dtype=np.float32), "takeable": spaces.MultiBinary(most)}
        )
        self.action_space = spaces.Discrete(most)
        self._most = most
        self.game = PalletGame.drawn(self.setting, np.random.default_rng(0))

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new pallet; the same seed gives the same one."""
        super().reset(seed=seed, options=options)
        self.game = PalletGame.drawn(self.setting, self.np_random)
        return self._seen()

    def step(self, action: np.int64) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Takes a box."""
        taken = self.game.take(int(action))
        observation, info = self._seen()
        info["refused"] = taken.refused
        return observation, taken.reward, taken.ended, False, info

    def render(self) -> str | None:
        """The boxes that are left, as text; those that may be taken are marked."""
        if self.render_mode is None:
            return None
        takeable = self.game.takeable()
        lines = []
        for number in np.flatnonzero(self.game.present).tolist():
            x, y, z = self.game.boxes[number].shape.centre
            mark = "*" if takeable[number] else " "
            p = self.game.priorities[number]
            wanted = f" wanted, p = {p:.2f}" if p else ""
            lines.append(f"{mark} {number:3d} at ({x:.2f}, {y:+.2f}, {z:.2f}) m{wanted}")
        return "\n".join(lines)

    def _seen(self) -> tuple[Observation, dict[str, Any]]:
        game = self.game
        boxes = np.zeros((self._most, len(LOW)), np.float32)
        takeable = np.zeros(self._most, np.int8)
        for number in np.flatnonzero(game.present).tolist():
            shape = game.boxes[number].shape
            half = np.abs(shape.pose.rotation) @ np.array(shape.size)
            boxes[number] = (*shape.centre, *half, game.priorities[number])
        takeable[: len(game.boxes)] = game.takeable()
        info = {"action_mask": takeable.copy(), "pallet": game.pile.kind, "waiting": game.waiting}
        return {"boxes": boxes, "takeable": takeable}, info


def _most(name: str) -> int:
    """How many boxes a pallet of a kind can have; what is unknown is refused elsewhere."""
    if name == REAL:
        return max(len(each.stack or ()) for each in shipped_deliveries())
    return max(COUNTS)
