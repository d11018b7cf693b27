"""Trains the trust of recognition: when a face bears a print, and not an unknown sibling's.

Faces of simulated scenes are compared with their own product's picture and with pictures of
siblings that differ in words, amount or colour, as if these were the products that are known.

    python scripts/train_prints.py --scenes 120 --severity normal
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from depal.cell.files import shipped_cell
from depal.domain import Product
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.perception.faces import Facing
from depal.perception.recognition.details import reading
from depal.perception.recognition.identity import laid_over_face
from depal.perception.recognition.patches import Patch
from depal.perception.recognition.prints import Gallery, print_of
from depal.perception.recognition.rectifying import rectified
from depal.perception.recognition.trust import Trust, evidence
from depal.simulation.imaging.photographs import Studio, photographed
from depal.simulation.scenes import Kind, Severity, random_delivery, scene
from depal.simulation.scenes.foreign import foreign_number

Floats = npt.NDArray[np.float64]

FIRST = 40_000
"""Seeds of the scenes begin here: no figure is measured on them."""

SHIFT, TURN, SIZE = 0.003, np.radians(0.4), 0.004
"""Faces are looked at with a pose and a size that are wrong by so much: standard deviations."""

SIBLINGS = 2
"""Each product is compared with so many siblings."""

COSTLY = 3.0
"""An accepted sibling weighs as much as so many unnamed boxes."""

ACCEPTED = 0.012
"""So many of the siblings may be accepted."""

LOWEST = 0.9
"""Faces whose label may reach farther down are not learned from."""


def main() -> None:
    """Trains, says how good it is on the scenes left out, and writes the file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--scenes", type=int, default=120)
    parser.add_argument("--severity", type=Severity, default=Severity.NORMAL)
    chosen = parser.parse_args()
    rows, own, groups = list[Floats](), list[bool](), list[int]()
    for number in range(chosen.scenes):
        for numbers, true in samples(FIRST + number, chosen.severity):
            rows.append(numbers)
            own.append(true)
            groups.append(number)
    inputs, true, group = np.array(rows), np.array(own), np.array(groups)
    odds = np.zeros(len(true))
    for part in range(5):
        left = group % 5 == part
        trust = fitted(inputs[~left], true[~left])
        odds[left] = [trust.log_odds(numbers) for numbers in inputs[left]]
    limit = float(np.quantile(odds[~true], 1 - ACCEPTED))
    for share in (0.005, 0.01, ACCEPTED, 0.02, 0.05):
        at = np.quantile(odds[~true], 1 - share)
        print(f"{share:.1%} of siblings accepted: {(odds[true] > at).mean():.1%} named, {at:.2f}")
    whole = fitted(inputs, true, limit)
    file = Path(__file__).parents[1] / "src/depal/perception/recognition/trust.json"
    file.write_text(whole.as_text(), "utf-8")
    print(f"{true.sum()} faces, {(~true).sum()} siblings")


def samples(seed: int, severity: Severity) -> Iterator[tuple[Floats, bool]]:
    """The numbers of faces and prints, and whether the print is the face's own."""
    random = np.random.default_rng(seed)
    shipped = shipped_deliveries()
    delivery = random_delivery(seed) if seed % 3 else shipped[seed // 3 % len(shipped)]
    made = scene(delivery, shipped_cell("default"), seed, severity, list(Kind)[seed % 4 % 3])
    galleries = {
        gtin: [one_product(product, product, random)]
        + [one_product(product, sibling, random) for sibling in siblings(product, random)]
        for gtin, product in delivery.products.items()
    }
    for box in made.truth.boxes:
        for facing, face in ((Facing.FRONT, box.front), (Facing.TOP, box.top)):
            if not face.counts:
                continue
            pose, size = disturbed(face.cell_from_face, face.size, random)
            patch = rectified(made.frames, facing, pose, size)
            if patch is None:
                continue
            for k, gallery in enumerate(galleries[box.gtin]):
                numbers = numbers_of(patch, gallery)
                if numbers is not None:
                    yield numbers, k == 0


def numbers_of(patch: Patch, gallery: Gallery) -> Floats | None:
    """The evidence on a face for the one product of a gallery."""
    fits = laid_over_face(patch, gallery)
    if not fits or fits[0].printed.label_ends > LOWEST:
        return None
    best = max(fits, key=lambda fit: fit.agreed.cosine - fit.agreed.worst)
    printed = best.printed.levels[best.level]
    return evidence(best.agreed, best.level, reading(best.seen, printed, best.printed.small))


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


def fitted(inputs: Floats, true: npt.NDArray[np.bool_], limit: float = 0.0) -> Trust:
    """Logistic regression with a quadratic penalty."""
    middle, scale = inputs.mean(axis=0), inputs.std(axis=0) + 1e-6
    scaled = np.column_stack(((inputs - middle) / scale, np.ones(len(inputs))))
    sign, cost = np.where(true, 1.0, -1.0), np.where(true, 1.0, COSTLY)
    kept = np.append(np.ones(inputs.shape[1]), 0.0)

    def loss(weights: Floats) -> tuple[float, Floats]:
        margin = sign * (scaled @ weights)
        value = cost @ np.logaddexp(0.0, -margin) + kept @ weights**2
        pull = cost * sign / (1.0 + np.exp(np.minimum(margin, 50.0)))
        return float(value), -scaled.T @ pull + 2.0 * kept * weights

    best = minimize(loss, np.zeros(scaled.shape[1]), jac=True, method="L-BFGS-B").x
    return Trust(middle, scale, best[:-1], float(best[-1]), limit)


if __name__ == "__main__":
    main()
