"""The words of the cell as immutable values. Metres, kilograms, seconds, radians."""

from depal.domain.box import Box, Detection, Perceived, Recognition
from depal.domain.delivery import (
    EURO_PALLET,
    PALLET_FRONT_X,
    STACK_TOLERANCE,
    Delivery,
    DeliveryLine,
    StackedCase,
    cell_from_pallet,
)
from depal.domain.grasp import Approach, Cup, Grasp
from depal.domain.layout import (
    CameraMount,
    CellLayout,
    Fiducial,
    PalletStand,
    ReaderMount,
    SpeedLimits,
    Storage,
    StorageKind,
    Zone,
)
from depal.domain.names import BoxId, Gtin, PlaceId
from depal.domain.place import Place
from depal.domain.product import Product
from depal.domain.request import Request
from depal.domain.robot import (
    JOINT_AXES,
    LINKS,
    ArmGeometry,
    Capsule,
    JointLimits,
    Joints,
    Robot,
)
from depal.domain.settings import checked_share
from depal.domain.tool import FRONT, LOWER, Suction, SuctionModule, Tool

__all__ = [
    "EURO_PALLET",
    "FRONT",
    "JOINT_AXES",
    "LINKS",
    "LOWER",
    "PALLET_FRONT_X",
    "STACK_TOLERANCE",
    "Approach",
    "ArmGeometry",
    "Box",
    "BoxId",
    "CameraMount",
    "Capsule",
    "CellLayout",
    "Cup",
    "Delivery",
    "DeliveryLine",
    "Detection",
    "Fiducial",
    "Grasp",
    "Gtin",
    "JointLimits",
    "Joints",
    "PalletStand",
    "Perceived",
    "Place",
    "PlaceId",
    "Product",
    "ReaderMount",
    "Recognition",
    "Request",
    "Robot",
    "SpeedLimits",
    "StackedCase",
    "Storage",
    "StorageKind",
    "Suction",
    "SuctionModule",
    "Tool",
    "Zone",
    "cell_from_pallet",
    "checked_share",
]
