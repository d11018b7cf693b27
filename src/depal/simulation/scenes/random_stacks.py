"""Random deliveries beside the real ones."""

import numpy as np
from biip.checksums import gs1_standard_check_digit

from depal.domain import EURO_PALLET, Delivery, DeliveryLine, Gtin, Product
from depal.errors import DeliveryError
from depal.simulation.stacking import stacked

EDGES = ((0.2, 0.45), (0.15, 0.35), (0.12, 0.3))
"""Length, width and height of a case lie in these bounds [m]."""

TWINS = 0.4
"""So many products have the size and the range of the one before."""


def random_delivery(seed: int) -> Delivery:
    """A delivery of random products on a stack that the note alone makes.

    Args:
        seed: of everything in it.

    Returns:
        Between 12 and 45 cases of 3 to 8 products; several are of one size and one range.
    """
    random = np.random.default_rng([seed, 11])
    lines, total = list[DeliveryLine](), int(random.integers(12, 46))
    count = int(random.integers(3, 9))
    begins, size = "", (0.3, 0.2, 0.2)
    while len(lines) < count:
        if not lines or random.random() > TWINS:
            begins = f"{random.integers(10**10):010d}"
            a, b, c = (round(float(random.uniform(*bounds)), 3) for bounds in EDGES)
            size = (max(a, b), min(a, b), c)
        body = begins + f"{random.integers(1000):03d}"
        gtin = Gtin(body + str(gs1_standard_check_digit(body)))
        if gtin in {line.product.gtin for line in lines}:
            continue
        mass = round(float(np.prod(size)) * float(random.uniform(250, 600)), 3)
        product = Product(gtin, f"article {body[-6:]}", size, mass)
        lines.append(DeliveryLine(product, max(total // count, 1)))
    while True:
        delivery = Delivery(f"random-{seed}", EURO_PALLET, tuple(lines))
        try:
            stack = stacked(delivery)
        except DeliveryError:
            lines = [DeliveryLine(line.product, max(line.count - 1, 1)) for line in lines]
            continue
        return Delivery(delivery.id, EURO_PALLET, tuple(lines), stack)
