"""What is abnormal and needs an action; the only place of saturated colour."""

from depal.server.cellstate import Alarm, CellState
from depal.server.screen.markup import Markup, icon, joined, tag
from depal.server.screen.said import Said
from depal.server.screen.words import Words


def alarms(state: CellState, shown: str, words: Words, said: Said) -> Markup:
    """The alarms that the card does not show.

    Args:
        state: of the cell.
        shown: the alarm or the question that the card is about.
        words: of the screen.
        said: puts what the cell says into the screen's language.
    """
    others = [alarm for alarm in state.alarms if alarm.id != shown]
    if not others:
        return Markup()
    items = joined(_item(alarm, words, said) for alarm in others)
    return tag("ul", items, cls="alarms", aria_label=words("alarms.title"))


def _item(alarm: Alarm, words: Words, said: Said) -> Markup:
    urgent = "urgent" if alarm.urgent else "later"
    sign = icon("warning" if alarm.urgent else "info")
    label = tag("span", words(f"alarms.{urgent}"), cls="word")
    body = tag("span", tag("strong", said(alarm.text)), " ", said(alarm.todo))
    return tag("li", sign, label, body, cls=f"alarm is-{urgent}")
