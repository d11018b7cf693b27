"""Where a camera stands and how its depths are scaled, from markers fixed to the cell."""

from depal.perception.calibration.calibration import Calibration, calibrate, nominal_k
from depal.perception.calibration.checking import LIMIT, MarkerCheck, check, checked
from depal.perception.calibration.files import calibrations_for, fields_of, read_calibrations
from depal.perception.calibration.scaling import DepthScale

__all__ = [
    "LIMIT",
    "Calibration",
    "DepthScale",
    "MarkerCheck",
    "calibrate",
    "calibrations_for",
    "check",
    "checked",
    "fields_of",
    "nominal_k",
    "read_calibrations",
]
