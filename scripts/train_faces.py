"""Trains the score of faces on simulated scenes: `python scripts/train_faces.py`.

Scenes have seeds below a million; the bench of perception begins at two million. Two rounds: the
second learns from the rectangles that the first believed in. Of the two scores the one of fronts
learns from all faces, that of tops from tops alone.
"""

import argparse
import functools
import itertools
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import depal.perception.scoring
from depal.app.progress import progress_bar
from depal.cell.files import shipped_cell
from depal.domain import CellLayout, Delivery
from depal.logistics import read_deliveries, shipped_deliveries
from depal.perception.detecting import Finder, Printed
from depal.perception.faces import Raster
from depal.perception.observing import printed_on
from depal.perception.recognition import gallery_of
from depal.perception.scoring import FaceScore
from depal.simulation.imaging.photographs import book_of
from depal.simulation.scenes import Scene, random_delivery
from depal.studies.training.examples import Examples, examples_of
from depal.studies.training.network import trained

KNOWN = 0.8
"""Share of the products on the note that there are pictures of."""

SHARE = 0.5
"""Share of the scenes that show a real delivery; the others are drawn by lot."""


def one(
    seed: int, layout: CellLayout, deliveries: tuple[Delivery, ...], finder: Finder | None
) -> Examples:
    """The examples of one scene."""
    random = np.random.default_rng([seed, 78])
    if random.random() < SHARE:
        delivery = deliveries[int(random.integers(len(deliveries)))]
    else:
        delivery = random_delivery(seed)
    return examples_of(delivery, layout, seed, finder, shown_prints)


def shown_prints(raster: Raster, made: Scene, random: np.random.Generator) -> tuple[Printed, ...]:
    """Where the prints of most products on the note appear; some nobody has photographed."""
    products = [line.product for line in made.note.lines]
    book = book_of(products, int(random.integers(1 << 30)), KNOWN)
    return printed_on(raster, gallery_of(book, made.note.lines))


def main() -> None:
    """Trains and writes the file that ships."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=400)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--deliveries", type=Path, help="a file of deliveries beside those shipped")
    default = Path(depal.perception.scoring.__file__).parent
    parser.add_argument("--out", type=Path, default=default, help="folder")
    options = parser.parse_args()
    deliveries = shipped_deliveries()
    if options.deliveries:
        deliveries += read_deliveries(options.deliveries)
    finder: Finder | None = None
    half = options.scenes // 2
    examples = list[Examples]()
    for seeds in (range(half), range(half, options.scenes)):
        work = functools.partial(
            one, layout=shipped_cell("default"), deliveries=deliveries, finder=finder
        )
        with ProcessPoolExecutor(options.workers) as pool, progress_bar("Scenes") as tell:
            for done, each in enumerate(pool.map(work, seeds), start=1):
                examples.append(each)
                tell(done, len(seeds))
        finder = Finder(report(examples), report([each.looking_up for each in examples]))
    if finder is not None:
        (options.out / "faces.json").write_text(finder.score.as_text(), encoding="utf-8")
        (options.out / "tops.json").write_text(finder.tops.as_text(), encoding="utf-8")


def report(examples: list[Examples]) -> FaceScore:
    """Trains on all, after it has told how well training on most foretells the rest."""
    most = Examples.joined(examples[: -max(len(examples) // 5, 1)])
    rest = Examples.joined(examples[-max(len(examples) // 5, 1) :])
    score = trained(most.features, most.faces, np.random.default_rng(0))
    chance = 1.0 / (1.0 + np.exp(-score.log_odds(rest.features)))
    right = rest.faces > 0.0
    loss = -np.log(np.where(right, chance, 1.0 - chance)).mean()
    print(
        f"{len(most.faces)} rectangles learned from, {len(rest.faces)} kept back: loss {loss:.4f}"
    )
    for low, high in itertools.pairwise((0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)):
        some = (chance >= low) & (chance < high)
        share = right[some].mean() if some.any() else float("nan")
        print(f"  {low:.1f} to {high:.1f}: {some.sum():6d}, of which faces {share:.3f}")
    every = Examples.joined(examples)
    return trained(every.features, every.faces, np.random.default_rng(0))


if __name__ == "__main__":
    main()
