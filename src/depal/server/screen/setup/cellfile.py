"""What the cell file says, in short."""

from nicegui import ui

from depal.domain import CellLayout
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.pane import html
from depal.server.screen.words import Words, place_name


class CellPart:
    """Read only: the file is changed by hand, and checked by `depal cell check`."""

    def __init__(self, layout: CellLayout, words: Words) -> None:
        """Lays it out."""
        with ui.element("section").classes("card"):
            html(words("cell.title"), "h2").classes("h3")
            html(words("cell.how"), "p").classes("quiet")
            html(cell_summary(layout, words))

    async def open(self) -> None:
        """It stays as it is while the cell runs."""


def cell_summary(layout: CellLayout, words: Words) -> Markup:
    """A table of what stands where."""
    (left, low), (right, high) = layout.floor
    length, width, deck = layout.pallet.size
    shares = [
        ("cell.name", layout.name),
        ("cell.robot", f"{layout.robot.name}, {layout.robot.payload:g} kg"),
        ("cell.floor", f"{right - left:.1f} x {high - low:.1f} m"),
        ("cell.pallet", f"{length:.2f} x {width:.2f} x {deck:.3f} m"),
        ("cell.places", ", ".join(place_name(storage.id, words) for storage in layout.storages)),
        ("cell.levels", str(len(layout.places))),
        ("cell.aside", place_name(layout.aside, words)),
        ("cell.cameras", ", ".join(camera.name for camera in layout.cameras)),
        ("cell.speed", f"{layout.speeds.flange:g} m/s"),
    ]
    rows = joined(
        tag("tr", tag("th", words(key), scope="row"), tag("td", value)) for key, value in shares
    )
    return tag("table", tag("tbody", rows), cls="plain")
