"""Trains the trust of recognition: when a face bears a print, and not an unknown sibling's.

Faces of simulated scenes are compared with their own product's picture and with pictures of
siblings that differ in words, amount or colour, as if these were the products that are known.

    python scripts/train_prints.py --scenes 180 --severity normal
"""

import argparse
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
from rich.progress import track

from depal.cell.files import shipped_cell
from depal.domain import Product
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.perception.detecting import Expected
from depal.perception.faces import Face, Facing
from depal.perception.locating import located
from depal.perception.recognition.identity import evidence, laid_over_face
from depal.perception.recognition.prints import Gallery, print_of
from depal.perception.recognition.rectifying import rectified
from depal.perception.recognition.trust import FARTHEST, Trust
from depal.ports import Frame
from depal.simulation.imaging.photographs import Studio, photographed
from depal.simulation.scenes import Kind, Severity, random_delivery, scene
from depal.simulation.scenes.foreign import foreign_number
from depal.studies.perception.scenes import calibrated
from depal.studies.training.network import Schooling, trained

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

FIRST = 40_000
"""Seeds of the scenes begin here: no figure is measured on them."""

SHIFT, TURN, SIZE = 0.003, np.radians(0.4), 0.004
"""Faces are looked at with a pose and a size that are wrong by so much: standard deviations."""

SIBLINGS = 3
"""Each product is compared with so many siblings."""

COSTLY = 3
"""An accepted sibling weighs as much as so many unnamed boxes."""

ACCEPTED = 0.0075
"""So many of the siblings may be accepted."""

PARTS = 4
"""What it is worth is measured on one of so many parts, trained on the others."""

NETWORKS = 6
HOW = Schooling(hidden=24, steps=2000, batch=1024, rate=5e-3, decay=5e-4)


def main() -> None:
    """Trains, says how good it is on the scenes left out, and writes the file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--scenes", type=int, default=180)
    parser.add_argument("--severity", type=Severity, default=Severity.NORMAL)
    parser.add_argument("--workers", type=int, default=1, help="processes that look at scenes")
    parser.add_argument("--examples", type=Path, help="kept there; read where they are already")
    chosen = parser.parse_args()
    for option, number, least in (("scenes", chosen.scenes, PARTS), ("workers", chosen.workers, 1)):
        if number < least:
            parser.error(f"--{option} is {number}; {least} or more are needed")
    if chosen.examples is not None and chosen.examples.exists():
        kept = np.load(chosen.examples)
        inputs, true, group = kept["inputs"], kept["true"], kept["group"]
    else:
        inputs, true, group = examples(chosen.scenes, chosen.severity, chosen.workers)
        if chosen.examples is not None:
            np.savez(chosen.examples, inputs=inputs, true=true, group=group)
    odds = np.zeros(len(true))
    for part in range(PARTS):
        left = group % PARTS == part
        odds[left] = odds_of(fitted(inputs[~left], true[~left]), inputs[left])
    for share in (0.002, 0.005, 0.01, 0.02, 0.05):
        at = np.quantile(odds[~true], 1 - share)
        print(f"{share:.1%} of siblings accepted: {(odds[true] > at).mean():.1%} named, {at:.2f}")
    limit = float(np.quantile(odds[~true], 1 - ACCEPTED))
    whole = fitted(inputs, true, limit)
    file = Path(__file__).parents[1] / "src/depal/perception/recognition/trust.json"
    file.write_text(whole.as_text(), "utf-8")
    print(f"{true.sum()} faces, {(~true).sum()} siblings; believed from {limit:.2f} on")


def examples(
    scenes: int, severity: Severity, workers: int
) -> tuple[Floats, Flags, npt.NDArray[np.int64]]:
    """Numbers, whether they are of the face's own print, and the scene, of many faces."""
    rows, own, groups = list[Floats](), list[bool](), list[int]()
    with ProcessPoolExecutor(workers) as pool:
        of_scenes = pool.map(partial(of_scene, severity), range(FIRST, FIRST + scenes))
        for number, found in enumerate(track(of_scenes, "Scenes", scenes)):
            rows += [numbers for numbers, _ in found]
            own += [true for _, true in found]
            groups += [number] * len(found)
    return np.array(rows), np.array(own), np.array(groups)


def of_scene(severity: Severity, seed: int) -> list[tuple[Floats, bool]]:
    """What one scene shows: all of it, in a process of its own."""
    cv2.setNumThreads(1)
    return list(samples(seed, severity))


def samples(seed: int, severity: Severity) -> Iterator[tuple[Floats, bool]]:
    """The numbers of faces and prints, and whether the print is the face's own."""
    random = np.random.default_rng(seed)
    shipped = shipped_deliveries()
    delivery = random_delivery(seed) if seed % 3 else shipped[seed // 3 % len(shipped)]
    made = scene(delivery, shipped_cell("default"), seed, severity, list(Kind)[seed % 4 % 3])
    there = {box.gtin for box in made.truth.boxes}
    frames = calibrated(made)
    galleries = {
        gtin: [
            one_product(product, looks, random) for looks in (product, *siblings(product, random))
        ]
        for gtin, product in delivery.products.items()
        if gtin in there
    }
    for box in made.truth.boxes:
        for facing, face in ((Facing.FRONT, box.front), (Facing.TOP, box.top)):
            if not face.counts:
                continue
            pose, size = disturbed(face.cell_from_face, face.size, random)
            found = Face(facing, pose, size, 1.0)
            for k, gallery in enumerate(galleries[box.gtin]):
                numbers = numbers_of(found, frames, gallery)
                if numbers is not None:
                    yield numbers, k == 0


def numbers_of(found: Face, frames: Sequence[Frame], gallery: Gallery) -> Floats | None:
    """The evidence on a face for the one product of a gallery, where that one's print has it."""
    expected = Expected(tuple({printed.product.size for printed in gallery.prints}))
    face = located(found, frames, expected.faces(found.facing), gallery)
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    fits = [] if patch is None else laid_over_face(patch, gallery)
    if not fits:
        return None
    return evidence(max(fits, key=lambda fit: fit.agreed.cosine - fit.agreed.worst))


def one_product(product: Product, looks: Product, random: np.random.Generator) -> Gallery:
    """A product with the looks of this or another one, as the only one that is known."""
    faces = photographed(looks, random, Studio()).faces
    return Gallery(tuple(print_of(product, *face) for face in faces.items()), (), complete=True)


def siblings(product: Product, random: np.random.Generator) -> list[Product]:
    """Products of the same range and size."""
    numbers = [
        foreign_number(random, frozenset({product.gtin}), product.gtin) for _ in range(SIBLINGS)
    ]
    return [Product(number, product.name, product.size, product.mass) for number in numbers]


def disturbed(
    pose: Pose, size: tuple[float, float], random: np.random.Generator
) -> tuple[Pose, tuple[float, float]]:
    """A face as a detector finds it."""
    x, y = random.normal(0.0, SHIFT, 2).tolist()
    turn = float(random.normal(0.0, TURN))
    c, s = np.cos(turn), np.sin(turn)
    off = Pose((x, y, float(random.normal(0.0, SHIFT))), ((c, -s, 0), (s, c, 0), (0, 0, 1)))
    width, height = (edge + float(random.normal(0.0, SIZE)) for edge in size)
    return pose @ off, (width, height)


def fitted(inputs: Floats, true: Flags, limit: float = 0.0) -> Trust:
    """Networks that begin differently and are trained alike."""
    middle, scale = inputs.mean(axis=0), inputs.std(axis=0) + 1e-6
    scaled = np.clip((inputs - middle) / scale, -FARTHEST, FARTHEST)
    # An accepted sibling costs more than an unnamed box: it is there more often.
    rows = np.concatenate((np.flatnonzero(true), np.repeat(np.flatnonzero(~true), COSTLY)))
    first, second = [], []
    for seed in range(NETWORKS):
        net = trained(scaled[rows], true[rows].astype(float), np.random.default_rng(seed), HOW)
        weights = net.first[:-1] / net.scale[:, None]
        first.append(np.vstack((weights, net.first[-1] - net.middle @ weights)))
        second.append(net.second)
    return Trust(middle, scale, np.array(first), np.array(second), limit)


def odds_of(trust: Trust, inputs: Floats) -> Floats:
    """Of many."""
    return np.array([trust.log_odds(numbers) for numbers in inputs])


if __name__ == "__main__":
    main()
