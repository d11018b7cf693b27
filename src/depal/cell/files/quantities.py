"""The numbers and names that a cell file may hold, each with its unit and its limits."""

import re
from collections.abc import Callable
from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema
from pydantic.config import JsonDict

from depal.logistics.findings import shown
from depal.logistics.quantities import of_length, refused

FARTHEST = 20.0
"""No cell is larger [m]."""

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def _within(least: float, most: float, unit: str) -> Callable[[float], float]:
    """A check of a number's range."""

    def checked(value: float) -> float:
        if not least <= value <= most:
            side = "above" if value > most else "below"
            limit = most if value > most else least
            raise refused(f"{value:.9g} is {side} {limit:g}{unit}")
        return value

    return checked


def _range(least: float, most: float) -> JsonDict:
    return {"type": "number", "minimum": least, "maximum": most}


def _name(value: str) -> str:
    if not _NAME.fullmatch(value):
        what = f"{shown(value)} is no name" if value else "is empty"
        raise refused(what, "letters, digits, _ and -, a letter first")
    return value


def _word(value: str) -> str:
    if not _WORD.fullmatch(value):
        what = f"{shown(value)} is no name" if value else "is empty"
        raise refused(what, "letters, digits and _, a letter first: task files call it so")
    return value


LISTED = Field(strict=False)
"""YAML knows lists alone; strictness would ask for a tuple."""

Length = Annotated[
    float,
    AfterValidator(_within(0.001, FARTHEST, " m")),
    WithJsonSchema(_range(0.001, FARTHEST)),
]
"""An edge, a radius or a distance [m]."""

Offset = Annotated[
    float,
    AfterValidator(_within(-FARTHEST, FARTHEST, " m")),
    WithJsonSchema(_range(-FARTHEST, FARTHEST)),
]
"""A coordinate or an offset of either sign [m]."""

Height = Annotated[
    float, AfterValidator(_within(0.0, FARTHEST, " m")), WithJsonSchema(_range(0.0, FARTHEST))
]
"""A height above the ground, or a thickness that may be none [m]."""

Degrees = Annotated[
    float, AfterValidator(_within(-720.0, 720.0, " deg")), WithJsonSchema(_range(-720.0, 720.0))
]
"""An angle [deg]."""

View = Annotated[
    float, AfterValidator(_within(5.0, 150.0, " deg")), WithJsonSchema(_range(5.0, 150.0))
]
"""An angle of view [deg]."""

AxisSpeed = Annotated[
    float, AfterValidator(_within(1.0, 2000.0, " deg/s")), WithJsonSchema(_range(1.0, 2000.0))
]
"""Of an axis [deg/s]."""

Speed = Annotated[
    float, AfterValidator(_within(0.001, 10.0, " m/s")), WithJsonSchema(_range(0.001, 10.0))
]
"""[m/s]."""

Mass = Annotated[
    float, AfterValidator(_within(0.001, 5000.0, " kg")), WithJsonSchema(_range(0.001, 5000.0))
]
"""[kg]."""

Seconds = Annotated[
    float, AfterValidator(_within(0.001, 60.0, " s")), WithJsonSchema(_range(0.001, 60.0))
]
"""A duration [s]."""

Pressure = Annotated[
    float, AfterValidator(_within(100.0, 101325.0, " Pa")), WithJsonSchema(_range(100.0, 101325.0))
]
"""Below the pressure around [Pa]."""

Friction = Annotated[
    float, AfterValidator(_within(0.01, 2.0, "")), WithJsonSchema(_range(0.01, 2.0))
]
"""A coefficient of friction."""

Stiffness = Annotated[
    float, AfterValidator(_within(10.0, 1e7, " N/m")), WithJsonSchema(_range(10.0, 1e7))
]
"""[N/m]."""

Factor = Annotated[float, AfterValidator(_within(1.0, 10.0, "")), WithJsonSchema(_range(1.0, 10.0))]
"""A factor of safety."""

Pixels = Annotated[
    int,
    AfterValidator(_within(16, 10_000, " pixels")),
    WithJsonSchema({"type": "integer", "minimum": 16, "maximum": 10_000}),
]
"""Along one side of a picture."""

Pattern = Annotated[
    int,
    AfterValidator(_within(0, 49, "")),
    WithJsonSchema({"type": "integer", "minimum": 0, "maximum": 49}),
]
"""The number of a fiducial's pattern."""

Direction = Annotated[
    tuple[
        Annotated[float, AfterValidator(_within(-1.0, 1.0, "")), WithJsonSchema(_range(-1.0, 1.0))],
        ...,
    ],
    LISTED,
    BeforeValidator(of_length(3, 3, "number", "numbers")),
]
"""x, y, z of a direction; its length does not matter."""

Cups = Annotated[
    int,
    AfterValidator(_within(1, 20, "")),
    WithJsonSchema({"type": "integer", "minimum": 1, "maximum": 20}),
]
"""How many cups stand in a row."""

Name = Annotated[
    str,
    AfterValidator(_name),
    WithJsonSchema({"type": "string", "pattern": f"^{_NAME.pattern}$"}),
]
"""What something is called in the file and in every message about it."""

Word = Annotated[
    str,
    AfterValidator(_word),
    WithJsonSchema({"type": "string", "pattern": f"^{_WORD.pattern}$"}),
]
"""What something is called in task files too."""

TWO: JsonDict = {"minItems": 2, "maxItems": 2}
THREE: JsonDict = {"minItems": 3, "maxItems": 3}
SIX: JsonDict = {"minItems": 6, "maxItems": 6}
SEVEN: JsonDict = {"minItems": 7, "maxItems": 7}

_two = BeforeValidator(of_length(2, 2, "number", "numbers"))
_three = BeforeValidator(of_length(3, 3, "number", "numbers"))

Point = Annotated[tuple[Offset, ...], LISTED, _three]
"""x, y, z [m]."""

FloorPoint = Annotated[tuple[Offset, ...], LISTED, _two]
"""x, y [m]."""

Edges = Annotated[tuple[Length, ...], LISTED, _three]
"""Three edges [m]."""

Rectangle = Annotated[tuple[Length, ...], LISTED, _two]
"""Two edges [m]."""

PictureSize = Annotated[tuple[Pixels, ...], LISTED, _two]
"""Width and height [pixel]."""

SixAngles = Annotated[
    tuple[Degrees, ...], LISTED, BeforeValidator(of_length(6, 6, "angle", "angles"))
]
"""One angle for each axis [deg]."""
