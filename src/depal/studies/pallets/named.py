"""The generators by name."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from depal.errors import SettingError, did_you_mean
from depal.studies.pallets.columns import columns
from depal.studies.pallets.cubic import cubic
from depal.studies.pallets.dropped import dropped
from depal.studies.pallets.guillotine import guillotine
from depal.studies.pallets.layered import layered
from depal.studies.pallets.pallet import RandomPallet

PalletGenerator = Callable[[np.random.Generator], RandomPallet]
"""Draws one pallet."""

GENERATORS: Mapping[str, PalletGenerator] = MappingProxyType(
    {
        "guillotine": guillotine,
        "layered": layered,
        "cubic": cubic,
        "columns": columns,
        "dropped": dropped,
    }
)
"""The five generators by their names; `guillotine` is the one of the paper."""


def generator_named(name: str) -> PalletGenerator:
    """The generator of that name.

    Raises:
        SettingError: there is none; the message names those that exist.
    """
    try:
        return GENERATORS[name]
    except KeyError:
        exists = did_you_mean(name, GENERATORS)
        raise SettingError("generator", f"unknown name {name!r}", exists=exists) from None


def named_generators(names: str) -> tuple[str, ...]:
    """The names in a list with commas, each once, in their order.

    Raises:
        SettingError: one of them names no generator.
    """
    found = dict.fromkeys(name.strip() for name in names.split(","))
    for name in found:
        generator_named(name)
    return tuple(found)
