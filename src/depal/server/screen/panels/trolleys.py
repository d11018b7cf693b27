"""Trolleys and shelves with their fill."""

from depal.server.cellstate import CellState, TrolleyState
from depal.server.screen.markup import Markup, icon, joined, tag
from depal.server.screen.words import Words, place_name


def trolleys(state: CellState, words: Words) -> Markup:
    """One tile for each; what needs hands says so."""
    tiles = joined(_tile(trolley, words) for trolley in state.trolleys)
    return tag("ul", tiles, cls="trolleys")


def _tile(trolley: TrolleyState, words: Words) -> Markup:
    share = round(100 * min(max(trolley.fill, 0.0), 1.0))
    key, sign = _standing(trolley)
    gauge = tag("span", tag("span", style=f"height:{share}%"), cls="gauge", aria_hidden="true")
    fill = words("trolley.fill", boxes=trolley.boxes, share=share)
    return tag(
        "li",
        gauge,
        tag(
            "div",
            tag("strong", place_name(trolley.id, words)),
            tag("span", fill),
            tag("span", icon(sign) if sign else None, words(f"trolley.{key}"), cls="standing"),
        ),
        cls=f"trolley is-{key}",
    )


def _standing(trolley: TrolleyState) -> tuple[str, str]:
    if trolley.exchanging:
        return "exchange", "swap_horiz"
    if not trolley.present:
        return "absent", "block"
    if trolley.full:
        return "full", "inventory"
    return ("aside", "") if trolley.aside else ("ready", "")
