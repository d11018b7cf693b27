"""Products with prints, and faces of them under any light."""

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import DeliveryLine, Gtin, Product
from depal.perception.faces import Facing
from depal.perception.pictures import PictureBook, ProductPictures, side_size
from depal.perception.recognition.patches import FINE, MARGIN, Patch, patch_shape
from depal.simulation.imaging.photographs import Studio, drawn

Bytes = npt.NDArray[np.uint8]

PLAIN = Studio(labelled=0.0)
LABELLED = Studio(labelled=1.0)

SIZE = (0.26, 0.2, 0.18)


def product(number: int, size: tuple[float, float, float] = SIZE) -> Product:
    """A product; numbers that differ in their last four digits alone are siblings."""
    return Product(Gtin(f"{number:014d}"), f"article {number}", size, 4.0)


A = product(12000823_00017_0)
SIBLING = product(12000823_00025_0)
STRANGER = product(77000811_00025_0)
OTHER = product(12000823_00017_0 + 5_000_000)


def book_of_drawings(*products: Product) -> PictureBook:
    """Their faces as drawn, without labels."""
    random = np.random.default_rng(0)
    return PictureBook(
        {
            each.gtin: ProductPictures(
                each,
                {side: drawn(each, side, random, PLAIN) for side in ("end", "side", "top")},
            )
            for each in products
        }
    )


def note_of(*products: Product) -> list[DeliveryLine]:
    """One case of each."""
    return [DeliveryLine(each, 1) for each in products]


def face_of(
    shown: Product,
    side: str,
    moved: tuple[float, float, float] = (0.0, 0.0, 0.0),
    studio: Studio = PLAIN,
    blur: float = 1.0,
) -> Patch:
    """A face as a camera sees it: its picture on a grey ground.

    Args:
        shown: the product.
        side: which face.
        moved: the face lies so far to the right and down of where it is thought to be [m], and
            is turned clockwise by so much more [rad].
        studio: whether it bears a label.
        blur: Gauss curve's width [mm].
    """
    picture = drawn(shown, side, np.random.default_rng(1), studio)
    width, height = side_size(shown, side)
    soft = cv2.GaussianBlur(picture, (0, 0), blur)
    columns, rows = patch_shape((width, height), FINE, MARGIN)
    k = FINE * 1000
    c, s = k * np.cos(moved[2]), k * np.sin(moved[2])
    x0, y0 = (columns - 1) / 2 + moved[0] / FINE, (rows - 1) / 2 + moved[1] / FINE
    u0, v0 = (picture.shape[1] - 1) / 2, (picture.shape[0] - 1) / 2
    warp = np.array([[c, s, u0 - c * x0 - s * y0], [-s, c, v0 + s * x0 - c * y0]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    colour = cv2.warpAffine(
        soft,
        warp,
        (columns, rows),
        flags=flags,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(120,) * 3,
    )
    facing = Facing.TOP if side == "top" else Facing.FRONT
    known = np.ones((rows, columns), dtype=np.bool_)
    return Patch(facing, (width, height), np.asarray(colour, dtype=np.uint8), known)


def lit(
    patch: Patch,
    gains: tuple[float, float, float] = (1.0, 1.0, 1.0),
    gradient: tuple[float, float] = (0.0, 0.0),
    grain: float = 0.0,
    seed: int = 0,
) -> Patch:
    """The same face under another light.

    Args:
        patch: a face.
        gains: of red, green, blue.
        gradient: the light grows by so much from left to right, and from top to bottom.
        grain: standard deviation of noise.
        seed: of the noise.
    """
    height, width = patch.known.shape
    x, y = np.linspace(-0.5, 0.5, width)[None, :], np.linspace(-0.5, 0.5, height)[:, None]
    light = (1.0 + gradient[0] * x + gradient[1] * y)[..., None] * np.array(gains)
    noise = grain * np.random.default_rng(seed).standard_normal(patch.colour.shape)
    colour = np.clip(np.round(patch.colour * light + noise), 0, 255).astype(np.uint8)
    return Patch(patch.facing, patch.size, colour, patch.known, patch.step, patch.margin)
