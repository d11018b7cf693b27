"""Fits the belief over unseen volume to random pallets, and writes its weights.

    python scripts/fit_hidden.py [PALLETS]

PALLETS of each of the five generators are drawn (400 without a number), with a seed of their own;
a random number of boxes leave, one of those that nobody sees is wanted, and the weights make its
true place as likely as they can. Then the weights are tempered, apart for piles that are flush
and piles that are not, so that the region that is to hold 80 % of the belief holds the box so
often. Half of the pallets fit, the other half temper.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from rich.progress import track
from scipy.optimize import minimize

from depal.selection.access import members
from depal.selection.hidden import FEATURES, Belief, features, placements, softmax
from depal.studies.hidden import Looks, draw_hidden, true_place
from depal.studies.pallets import GENERATORS

Array = npt.NDArray[np.float64]

TARGET = Path(__file__).parent.parent / "src/depal/selection/hidden/weights.json"
SEED = 7_900
SHARE = 0.8
SHRINK = 1.0
TEMPERS = np.arange(0.2, 2.0, 0.1)
ROUNDS = 3


@dataclass(frozen=True)
class Example:
    """One unseen box: the generator, the features of all its places, and the true one."""

    kind: str
    first: bool
    features: Array
    true: int | None


def example(kind: str, index: int) -> Example | None:
    """One example; None where every box is seen."""
    trial = draw_hidden(kind, SEED, index)
    if trial is None:
        return None
    rng = np.random.default_rng((SEED, index))
    looks = Looks.first(trial.prisms)
    # Half of the beliefs are of the first look, half of later ones.
    for _ in range(int(rng.integers(0, 8)) * int(rng.integers(0, 2))):
        free = trial.ways.free(looks.gone) & looks.seen
        looks.remove(min(members(free), key=trial.scores.rank.__getitem__))
        looks.look()
        if looks.seen >> trial.requested & 1:
            return None
    scene = looks.scene()
    found = placements(scene, trial.size)
    seen = trial.prisms[list(members(looks.seen))]
    return Example(
        kind,
        not looks.gone,
        features(scene, found, seen),
        true_place(found, trial.prisms[trial.requested]),
    )


def fitted(examples: list[Example]) -> Array:
    """The weights that make the true places most likely, drawn a little towards 0."""
    known = [each for each in examples if each.true is not None]

    def cost(weights: Array) -> tuple[float, Array]:
        total, slope = SHRINK * weights @ weights / 2, SHRINK * weights
        for each in known:
            mass = softmax(each.features @ weights)
            total -= np.log(mass[each.true])
            slope = slope + mass @ each.features - each.features[each.true]
        return total, slope

    start = np.zeros(2 * len(FEATURES))
    found: Array = minimize(cost, start, jac=True, method="L-BFGS-B").x
    return found


def held(examples: list[Example], weights: Array) -> float:
    """How often the region holds the box."""
    shares = []
    for each in examples:
        mass = softmax(each.features @ weights)
        inside = Belief.region_of(mass, SHARE)
        shares.append(0.0 if each.true is None else inside[each.true])
    return float(np.mean(shares))


def tempered(examples: list[Example], weights: Array) -> Array:
    """The weights with the tempers that calibrate piles with gaps, and all others."""
    n = len(FEATURES)
    gaps = [each for each in examples if each.kind == "dropped"]
    flush = [each for each in examples if each.kind != "dropped"]

    def mixed(loose: float, tight: float) -> Array:
        return np.concatenate((loose * weights[:n], tight * (weights[:n] + weights[n:])
                               - loose * weights[:n]))  # fmt: skip

    loose = tight = 1.0
    for _ in range(ROUNDS):
        tight = min(TEMPERS, key=lambda each: abs(held(flush, mixed(loose, each)) - SHARE))
        loose = min(TEMPERS, key=lambda each: abs(held(gaps, mixed(each, tight)) - SHARE))
    print(f"tempers: {loose:.2f} in loose piles, {tight:.2f} in flush ones")
    return mixed(loose, tight)


def main() -> None:
    """Draws, fits, tempers, writes and says how well it is calibrated."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    asked = [(kind, index) for index in range(count) for kind in GENERATORS]
    drawn = [example(kind, index) for kind, index in track(asked, "Pallets")]
    examples = [each for each in drawn if each is not None]
    weights = tempered(examples[1::2], fitted(examples[::2]))
    for kind in GENERATORS:
        some = [each for each in examples[1::2] if each.kind == kind]
        firsts = [each for each in some if each.first]
        print(f"{kind}: {held(some, weights):.3f} of {len(some)}; "
              f"first looks: {held(firsts, weights):.3f} of {len(firsts)}")  # fmt: skip
    print(f"all: {held(examples[1::2], weights):.3f}")
    n = len(FEATURES)
    parts = {"any": weights[:n], "flush": weights[n:]}
    shipped = {
        name: dict(zip(FEATURES, np.round(part, 3).tolist(), strict=True))
        for name, part in parts.items()
    }
    TARGET.write_text(json.dumps(shipped, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
