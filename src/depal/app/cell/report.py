"""What `depal cell check` prints, writes and draws."""

from collections.abc import Sequence

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text

from depal.app.cell.picture import cell_picture
from depal.app.files import Json
from depal.app.reports.report import PlainTable, Report, plain_table
from depal.cell.checking import (
    CellFinding,
    CellReport,
    PlaceReach,
    Weight,
    check_cell,
    check_delivery_against_cell,
    sizes_of,
)
from depal.cell.files import find_cell
from depal.domain import Approach, CellLayout, Delivery
from depal.logistics import read_delivery

GRASPS = {Approach.HORIZONTAL: "front", Approach.VERTICAL: "top"}
"""How tables say where the cups touch."""


def cell_report(reference: str, delivery_reference: str | None) -> Report:
    """Checks a cell, and a delivery against it.

    Args:
        reference: a cell file, or the name of a shipped cell.
        delivery_reference: a delivery file, FILE#ID or a shipped delivery's name; or None.

    Returns:
        The result in its three forms; it holds where there are no errors.

    Raises:
        InputError: a file cannot be used.
    """
    layout = find_cell(reference)
    delivery = None if delivery_reference is None else read_delivery(delivery_reference)
    found: tuple[CellFinding, ...] = ()
    if delivery is None:
        checked = check_cell(layout)
    else:
        checked = check_cell(layout, sizes_of(delivery))
        found = check_delivery_against_cell(layout, delivery)
    findings = (*checked.findings, *found)

    def draw() -> Figure:
        return cell_picture(layout, checked)

    return Report(
        fields=_fields(layout, checked, delivery, findings),
        shown=_shown(layout, checked, delivery, findings),
        draw=draw,
        holds=all(finding.weight is not Weight.ERROR for finding in findings),
    )


def _shown(
    layout: CellLayout,
    checked: CellReport,
    delivery: Delivery | None,
    findings: Sequence[CellFinding],
) -> list[RenderableType]:
    boxes = "usual boxes" if delivery is None else f"boxes of {delivery.id}"
    lines: list[RenderableType] = [
        _pallet_table(checked, f"{layout.name}: {boxes} on the pallet"),
        _places_table(layout, checked),
        _reader_table(checked),
    ]
    lines += [
        f"camera {sight.camera}: sees {100 * sight.seen:.1f} % of the pallet's front up to 1.75 m "
        f"with the arm parked, from {sight.distance:.2f} m"
        for sight in checked.sights
    ]
    volume = sum(place.volume for place in layout.places.values())
    lines.append(f"room in all places: {volume:.2f} m3")
    if not findings:
        return [*lines, Text("no errors, no warnings", style="green")]
    colours = {Weight.ERROR: "red", Weight.WARNING: "yellow"}
    return [*lines, *(Text(str(finding), style=colours[finding.weight]) for finding in findings)]


def _pallet_table(checked: CellReport, title: str) -> PlainTable:
    table = plain_table(
        title,
        "box",
        "depth x width x height [m]",
        "mass [kg]",
        "from the front",
        "from the top",
        "either",
        "up to 1.66 m",
    )
    for reach in checked.pallet:
        load = reach.size
        held = [checked.held(load, approach) for approach in Approach]
        table.row(
            load.name,
            " x ".join(f"{edge:.2f}" for edge in load.size),
            f"{load.mass:.1f}",
            _share(reach.horizontal, held=held[0]),
            _share(reach.vertical, held=held[1]),
            _share(reach.either, held=True),
            _share(reach.usual, held=True),
        )
    return table


def _places_table(layout: CellLayout, checked: CellReport) -> PlainTable:
    columns = [
        f"{load.name}, {GRASPS[approach]}" for load in checked.sizes for approach in Approach
    ]
    title = "share of each place's floor that is reached, and how deep behind its opening [m]"
    table = plain_table(title, "place", "width x height x depth [m]", *columns)
    table.columns[0].no_wrap = True
    by_place: dict[str, list[PlaceReach]] = {}
    for reach in checked.places:
        by_place.setdefault(reach.place, []).append(reach)
    for place in layout.places.values():
        width, height = place.opening
        cells = [_reached(checked, reach) for reach in by_place[place.id]]
        table.row(place.id, f"{width:.2f} x {height:.2f} x {place.depth:.2f}", *cells)
    return table


def _reached(checked: CellReport, reach: PlaceReach) -> str:
    if not checked.held(reach.size, reach.approach):
        return "no grasp"
    if not reach.fits:
        return "too large"
    return f"{100 * reach.reached:.0f} % {reach.deepest:.2f}" if reach.reached else "0 %"


def _reader_table(checked: CellReport) -> PlainTable:
    table = plain_table(
        "sides that can be shown to the reader",
        "box",
        *(f"held by its {name}" for name in GRASPS.values()),
    )
    for load in checked.sizes:
        cells = [
            (", ".join(reach.sides) or "none") if reach.held else "no grasp"
            for reach in checked.reader
            if reach.size == load
        ]
        table.row(load.name, *cells)
    return table


def _share(value: float, *, held: bool) -> str:
    return f"{100 * value:.1f} %" if held else "no grasp"


def _fields(
    layout: CellLayout,
    checked: CellReport,
    delivery: Delivery | None,
    findings: Sequence[CellFinding],
) -> dict[str, Json]:
    return {
        "cell": layout.name,
        "delivery": None if delivery is None else delivery.id,
        "holds": all(finding.weight is not Weight.ERROR for finding in findings),
        "sizes": [
            {"name": load.name, "size": list(load.size), "mass": load.mass}
            for load in checked.sizes
        ],
        "pallet": [
            {
                "size": reach.size.name,
                "positions": reach.tried,
                "horizontal": reach.horizontal,
                "vertical": reach.vertical,
                "either": reach.either,
                "usual": reach.usual,
                "missed": [list(corner) for corner in reach.missed],
            }
            for reach in checked.pallet
        ],
        "places": [
            {
                "place": reach.place,
                "size": reach.size.name,
                "grasp": reach.approach.value,
                "fits": reach.fits,
                "positions": reach.tried,
                "reached": reach.reached,
                "deepest": reach.deepest if reach.reached else None,
            }
            for reach in checked.places
        ],
        "reader": [
            {
                "size": reach.size.name,
                "grasp": reach.approach.value,
                "sides": list(reach.sides),
            }
            for reach in checked.reader
        ],
        "cameras": [
            {
                "camera": sight.camera,
                "seen": sight.seen,
                "bands": [list(band) for band in sight.bands],
                "hidden_by": [[name, share] for name, share in sight.hidden_by],
                "distance": sight.distance,
            }
            for sight in checked.sights
        ],
        "volume": sum(place.volume for place in layout.places.values()),
        "findings": [
            {
                "weight": finding.weight.value,
                "where": finding.problem.where,
                "what": finding.problem.what,
                "expected": finding.problem.expected,
                "exists": finding.problem.exists,
                "gtin": finding.gtin or None,
            }
            for finding in findings
        ],
    }
