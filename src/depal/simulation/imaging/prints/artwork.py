"""The faces of a case, drawn at one texel per millimetre."""

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from depal.simulation.imaging.prints.design import KRAFT, WHITE, Colour, Design, Motif, Stock
from depal.simulation.imaging.prints.fonts import font

Bytes = npt.NDArray[np.uint8]

FINE = 3
"""Faces are drawn this much finer and then reduced, which smooths every edge."""

BRIGHT = 450
"""Above this sum of red, green and blue, dark letters are read more easily than light ones."""


class Canvas:
    """A face that is drawn in millimetres from its upper left corner."""

    def __init__(self, size: tuple[float, float], colour: Colour) -> None:
        """A face of this width and height [m] in one colour."""
        self.width, self.height = (max(round(edge * 1000), 8) for edge in size)
        self._image = Image.new("RGB", (self.width * FINE, self.height * FINE), colour)
        self._draw = ImageDraw.Draw(self._image)

    def area(self, corners: list[tuple[float, float]], colour: Colour) -> None:
        """A polygon [mm]."""
        self._draw.polygon([(x * FINE, y * FINE) for x, y in corners], fill=colour)

    def block(self, left: float, top: float, right: float, bottom: float, colour: Colour) -> None:
        """A rectangle [mm]."""
        self.area([(left, top), (right, top), (right, bottom), (left, bottom)], colour)

    def disc(self, x: float, y: float, radius: float, colour: Colour) -> None:
        """A filled circle [mm]."""
        frame = [(x - radius) * FINE, (y - radius) * FINE, (x + radius) * FINE, (y + radius) * FINE]
        self._draw.ellipse(frame, fill=colour)

    def text(
        self, words: str, middle: tuple[float, float], room: tuple[float, float], colour: Colour
    ) -> None:
        """Words around a point, as large as the room's width and height allow [mm]."""
        wide, high = room
        letters = font(max(int(high * FINE), 6))
        length = letters.getlength(words)
        if length > wide * FINE:
            letters = font(max(int(high * FINE * wide * FINE / length), 6))
        self._put(words, middle, letters, colour)

    def _put(
        self,
        words: str,
        middle: tuple[float, float],
        letters: ImageFont.FreeTypeFont,
        colour: Colour,
    ) -> None:
        at = (middle[0] * FINE, middle[1] * FINE)
        self._draw.text(at, words, fill=colour, font=letters, anchor="mm")

    def finished(self) -> Bytes:
        """The face at one texel per millimetre, its edges a little darker where it is folded."""
        reduced = self._image.reduce(FINE)
        face = np.asarray(reduced, dtype=np.float64)
        rows, columns = np.arange(self.height)[:, None], np.arange(self.width)[None, :]
        inward = np.minimum(
            np.minimum(rows, self.height - 1 - rows), np.minimum(columns, self.width - 1 - columns)
        )
        shade = 1.0 - 0.28 * np.exp(-inward / 1.6)
        return np.asarray(np.clip(face * shade[..., None], 0, 255), dtype=np.uint8)


def side(design: Design, size: tuple[float, float]) -> Bytes:
    """An upright side; width and height [m]. Its label covers the middle of the lower part."""
    if design.stock is Stock.GRAPHIC:
        return _graphic_side(design, size)
    ground = KRAFT if design.stock is Stock.KRAFT else WHITE
    canvas = Canvas(size, ground)
    w, h = canvas.width, canvas.height
    ink = _ink_of(design)
    canvas.text(design.brand.upper(), (w / 2, h * 0.15), (w * 0.7, h * 0.18), ink)
    canvas.text(
        f"{design.variety}   {design.contents}", (w / 2, h * 0.92), (w * 0.8, h * 0.085), ink
    )
    if design.stock is Stock.PLAIN:
        canvas.block(0, h * 0.80, w, h * 0.84, design.accent)
    else:
        _handling_marks(canvas, ink)
    return canvas.finished()


def top(design: Design, size: tuple[float, float]) -> Bytes:
    """The top; a strip of tape runs along it."""
    ground = {Stock.GRAPHIC: design.ground, Stock.PLAIN: WHITE, Stock.KRAFT: KRAFT}[design.stock]
    canvas = Canvas(size, ground)
    w, h = canvas.width, canvas.height
    if design.stock is Stock.GRAPHIC:
        canvas.disc(w * 0.5, h * 0.5, min(w, h) * 0.46, design.light)
        canvas.disc(w * 0.5, h * 0.5, min(w, h) * 0.41, design.accent)
        ink = _ink_on(design.accent, design)
        across = min(w, h)
        for words, below, room in (
            (design.brand, -0.13, (0.66, 0.22)),
            (design.variety, 0.07, (0.56, 0.13)),
            (design.contents, 0.22, (0.44, 0.11)),
        ):
            middle = (w / 2, h / 2 + below * across)
            canvas.text(words, middle, (room[0] * across, room[1] * across), ink)
        return canvas.finished()
    tape = min(50.0, h * 0.3)
    canvas.block(0, (h - tape) / 2, w, (h + tape) / 2, _blend(ground, (222, 200, 160), 0.55))
    canvas.block(0, h / 2 - 0.4, w, h / 2 + 0.4, _darker(ground))
    ink = _ink_of(design)
    canvas.text(design.brand.upper(), (w / 2, h * 0.17), (w * 0.5, h * 0.14), ink)
    words = f"{design.variety}   {design.contents}"
    canvas.text(words, (w / 2, h * 0.86), (w * 0.8, h * 0.1), ink)
    return canvas.finished()


def bottom(design: Design, size: tuple[float, float]) -> Bytes:
    """The bottom: bare board with its seam."""
    ground = WHITE if design.stock is Stock.PLAIN else KRAFT
    canvas = Canvas(size, ground)
    w, h = canvas.width, canvas.height
    canvas.block(0, h / 2 - 0.5, w, h / 2 + 0.5, _darker(ground))
    return canvas.finished()


def _graphic_side(design: Design, size: tuple[float, float]) -> Bytes:
    canvas = Canvas(size, design.ground)
    w, h = canvas.width, canvas.height
    _motif(canvas, design)
    canvas.text(
        design.brand, (w / 2, h * 0.17), (w * 0.78, h * 0.25), _ink_on(design.ground, design)
    )
    canvas.block(0, h * 0.86, w, h, design.accent)
    words = f"{design.variety}   {design.contents}"
    canvas.text(words, (w / 2, h * 0.93), (w * 0.86, h * 0.095), _ink_on(design.accent, design))
    return canvas.finished()


def _motif(canvas: Canvas, design: Design) -> None:
    """The shapes behind the words."""
    random = np.random.default_rng(design.seed)
    w, h = float(canvas.width), float(canvas.height)
    if design.motif is Motif.BAND:
        canvas.block(0, h * 0.32, w, h * 0.86, design.light)
        canvas.block(0, h * 0.32, w, h * 0.36, design.accent)
    elif design.motif is Motif.HILLS:
        for step, colour in enumerate((_blend(design.ground, design.light, 0.5), design.dark)):
            peaks = random.uniform(0.3, 0.6, 7) + 0.16 * step
            line = [(w * i / 6, h * float(p)) for i, p in enumerate(peaks)]
            canvas.area([(0, h), *line, (w, h)], colour)
    elif design.motif is Motif.SUN:
        x = w * float(random.choice((0.2, 0.8)))
        canvas.disc(x, h * 0.62, h * 0.42, _blend(design.ground, design.light, 0.35))
        canvas.disc(x, h * 0.62, h * 0.3, design.light)
        canvas.disc(x, h * 0.62, h * 0.2, design.accent)
    elif design.motif is Motif.SLANT:
        canvas.area([(0, h), (0, h * 0.8), (w, h * 0.3), (w, h)], design.light)
        canvas.area([(0, h * 0.8), (0, h * 0.7), (w, h * 0.2), (w, h * 0.3)], design.accent)
    elif design.motif is Motif.DOTS:
        for _ in range(26):
            x, y, r = random.uniform(0, w), random.uniform(0.32, 0.9) * h, random.uniform(4, 16)
            canvas.disc(float(x), float(y), float(r), _blend(design.ground, design.light, 0.55))
    else:
        for i in range(0, 12, 2):
            canvas.block(w * i / 12, h * 0.32, w * (i + 1) / 12, h, design.dark)


def _handling_marks(canvas: Canvas, ink: Colour) -> None:
    """Two arrows that say which way is up, where there is room beside the label."""
    w, h = float(canvas.width), float(canvas.height)
    beside = 200
    if w < beside:
        return
    for x in (w - 34, w - 20):
        canvas.block(x - 1.5, h * 0.45, x + 1.5, h * 0.62, ink)
        canvas.area([(x - 5, h * 0.45), (x + 5, h * 0.45), (x, h * 0.45 - 9)], ink)
    canvas.block(w - 41, h * 0.64, w - 13, h * 0.65, ink)


def _ink_on(ground: Colour, design: Design) -> Colour:
    """The range's text colour that stands out on a ground."""
    return design.dark if sum(ground) > BRIGHT else design.light


def _ink_of(design: Design) -> Colour:
    """What a case with little print is printed with."""
    if design.stock is Stock.KRAFT:
        return _darker((84, 58, 36))
    return design.dark if sum(design.accent) > BRIGHT * 1.4 else _darker(design.accent)


def _darker(colour: Colour) -> Colour:
    return _blend(colour, (20, 20, 24), 0.4)


def _blend(first: Colour, second: Colour, share: float) -> Colour:
    """Of two colours, `share` of the second."""
    r, g, b = (round(a + (b - a) * share) for a, b in zip(first, second, strict=True))
    return (r, g, b)
