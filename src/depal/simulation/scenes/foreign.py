"""Boxes that came by mistake: on no note and in no picture book."""

from dataclasses import replace

import numpy as np
from biip.checksums import gs1_standard_check_digit

from depal.domain import Gtin
from depal.simulation.cases import Case
from depal.simulation.imaging.prints.design import FAMILY_DIGITS, design_of, family_of


def with_foreign(
    cases: tuple[Case, ...], share: float, random: np.random.Generator, known: frozenset[Gtin]
) -> tuple[tuple[Case, ...], frozenset[int]]:
    """Some boxes replaced by others of the same size.

    Every second one is a sibling of the product that it replaces: artwork of the same range that
    differs in a word or a colour alone. The others are of a range that nobody knows.

    Args:
        cases: as they stand.
        share: of the boxes that are replaced.
        random: draws which.
        known: numbers that are none of theirs.

    Returns:
        All cases, and the places of the replaced ones.
    """
    count = round(share * len(cases))
    chosen = np.sort(random.permutation(len(cases))[:count]).tolist()
    replaced = list(cases)
    for n, k in enumerate(chosen):
        like = cases[k].gtin if n % 2 == 0 else None
        replaced[k] = replace(cases[k], gtin=foreign_number(random, known, like))
    return tuple(replaced), frozenset(chosen)


def foreign_number(
    random: np.random.Generator, known: frozenset[Gtin], like: str | None = None
) -> Gtin:
    """A well-formed number that is not known; of the range of `like`, and not of its look."""
    families = {family_of(gtin) for gtin in known}
    while True:
        begins = f"{random.integers(10**FAMILY_DIGITS):0{FAMILY_DIGITS}d}"
        if like is not None:
            begins = family_of(like)
        elif begins in families:
            continue
        body = begins + f"{random.integers(10 ** (13 - FAMILY_DIGITS)):03d}"
        gtin = Gtin(body + str(gs1_standard_check_digit(body)))
        if gtin not in known and (like is None or design_of(gtin) != design_of(like)):
            return gtin
