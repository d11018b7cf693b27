"""How far the delivery is: one line of numbers and a bar."""

from depal.server.cellstate import CellState, Mode
from depal.server.screen.markup import Markup, icon, tag
from depal.server.screen.panels.marks import ICONS
from depal.server.screen.words import Words

LEAST = 3
"""Boxes stored from which on a rate says something."""


def summary(state: CellState, words: Words) -> Markup:
    """Mode, delivery, progress."""
    mode = tag(
        "span",
        icon(ICONS[state.mode]),
        words(f"mode.{state.mode.value}"),
        cls=f"mode mode-{state.mode.value}",
    )
    if state.delivery is None:
        return tag("div", mode, cls="summary")
    name = tag("strong", state.delivery, cls="delivery")
    return tag("div", mode, name, _bar(state, words), _numbers(state, words), cls="summary")


def _bar(state: CellState, words: Words) -> Markup:
    gone = state.stored + state.aside + state.lost
    whole = max(state.boxes, 1)
    parts = (
        tag("span", cls="stored", style=f"width:{100 * state.stored / whole:.1f}%"),
        tag("span", cls="aside", style=f"width:{100 * state.aside / whole:.1f}%"),
        tag("span", cls="lost", style=f"width:{100 * state.lost / whole:.1f}%"),
    )
    label = words("summary.progress", gone=gone, boxes=state.boxes)
    return tag("div", *parts, cls="bar", role="img", aria_label=label)


def _numbers(state: CellState, words: Words) -> Markup:
    told = [tag("span", words("summary.stored", stored=state.stored, boxes=state.boxes))]
    if state.aside:
        told.append(tag("span", words("summary.aside", aside=state.aside)))
    if state.lost:
        told.append(tag("span", icon("warning"), words("summary.lost", lost=state.lost), cls="bad"))
    if state.stored >= LEAST and state.rate > 0:
        told.append(tag("span", words("summary.rate", rate=round(state.rate / 10) * 10)))
        if state.mode is Mode.EXECUTE:
            minutes = 60 * (state.boxes - state.stored - state.aside - state.lost) / state.rate
            told.append(tag("span", words("summary.left", minutes=max(round(minutes), 1))))
    return tag("div", *told, cls="numbers")
