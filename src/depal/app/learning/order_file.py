"""Files of recorded orders: JSON lines, one pallet a line."""

import functools
import json
import math
from collections.abc import Iterable, Iterator
from pathlib import Path

from pydantic import ValidationError

from depal.app.files import write_text
from depal.app.learning.order_model import OrderEntry
from depal.domain import Recognition
from depal.errors import OrderError, PileError, Problem
from depal.logistics.expectations import Expectations, Schema
from depal.logistics.findings import Finding, choices, place
from depal.logistics.request_model import RequestEntry
from depal.logistics.sentences import findings_of
from depal.logistics.source_text import read_text
from depal.selection import BlockingGraph
from depal.selection.learning import Order

ENDINGS = (".jsonl",)
"""How files of orders end."""

LIMIT = 256
"""No file of orders is larger [MiB]."""


def read_orders(path: Path) -> list[Order]:
    """All orders of a file.

    Raises:
        OrderError: the file cannot be used; with everything that is wrong with it.
    """
    text = read_text(path, OrderError, ENDINGS, LIMIT)
    orders: list[Order] = []
    problems: list[Problem] = []
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        found = _order_of(line)
        if isinstance(found, Order):
            orders.append(found)
        else:
            problems += [finding.at(_where(number, finding)) for finding in found]
    if not orders and not problems:
        problems.append(Problem("", "is empty", "one pallet a line, as JSON"))
    if problems:
        raise OrderError(str(path), problems)
    return orders


def write_orders(path: Path, orders: Iterable[Order], option: str) -> None:
    """Writes a file of orders that `read_orders` reads.

    Raises:
        SettingError: the file cannot be written.
    """
    lines = [json.dumps(_fields(order), separators=(",", ":")) for order in orders]
    write_text(path, "".join(f"{line}\n" for line in lines), option)


def order_schema() -> Schema:
    """The JSON Schema (draft 2020-12) of one line of a file of orders."""
    schema = OrderEntry.model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _order_of(line: str) -> Order | list[Finding]:
    try:
        value = json.loads(line)
    except (json.JSONDecodeError, RecursionError) as error:
        column = f" at column {error.colno}" if isinstance(error, json.JSONDecodeError) else ""
        return [Finding((), f"is no JSON{column}", "one pallet a line, as JSON")]
    try:
        entry = OrderEntry.model_validate(value)
    except ValidationError as error:
        return list(findings_of(error, Expectations(_schema())))
    findings = list(_contradictions(entry))
    if findings:
        return findings
    order = entry.as_order()
    try:
        BlockingGraph(order.boxes, order.tolerances)
    except PileError as error:
        return [Finding(("boxes",), problem.what, problem.expected) for problem in error.problems]
    return order


@functools.cache
def _schema() -> Schema:
    return OrderEntry.model_json_schema()


def _contradictions(entry: OrderEntry) -> Iterator[Finding]:
    names = [box.box for box in entry.boxes]
    for index, name in enumerate(names):
        if name in names[:index]:
            yield Finding(("boxes", index, "box"), f"two boxes are called {name!r}", "its own name")
    for index, name in enumerate(entry.order):
        if name not in names:
            what = f"no box is called {name!r}"
            yield Finding(("order", index), what, "one of the boxes", choices(name, names))
        elif name in entry.order[:index]:
            yield Finding(("order", index), f"{name!r} has left before", "each box once")
    yield from _wrong_times(entry)
    for index, request in enumerate(entry.requests):
        yield from _wrong_request(index, request, names)


def _wrong_times(entry: OrderEntry) -> Iterator[Finding]:
    if entry.times and len(entry.times) != len(entry.order):
        what = f"has {len(entry.times)} times for {len(entry.order)} boxes"
        yield Finding(("times",), what, "one for each box that left")
    elif list(entry.times) != sorted(entry.times):
        yield Finding(("times",), "go back", "the first time first")
    if not entry.times and any(request.at > 0 for request in entry.requests):
        what = "are missing, and a request came later than at the start"
        yield Finding(("times",), what, "one for each box that left")


def _wrong_request(index: int, request: RequestEntry, names: list[str]) -> Iterator[Finding]:
    if bool(request.gtin) == bool(request.box):
        what = "both gtin and box" if request.gtin else "neither gtin nor box"
        yield Finding(("requests", index), what, "one of them")
    elif request.box and request.box not in names:
        what = f"no box is called {request.box!r}"
        yield Finding(("requests", index, "box"), what, exists=choices(request.box, names))
    if request.due < request.at:
        what = f"{request.due:g} s is before the request comes"
        yield Finding(("requests", index, "due"), what, f"{request.at:g} s or later")


def _where(number: int, finding: Finding) -> str:
    return f"line {number}, {place(finding.loc)}" if finding.loc else f"line {number}"


def _fields(order: Order) -> dict[str, object]:
    boxes = []
    for box in order.boxes:
        (c, _, _), (s, _, _), _ = box.shape.pose.rotation
        fields = {"box": box.id, "centre": box.shape.centre, "size": box.shape.size}
        turned = {"yaw": math.atan2(s, c)} if s else {}
        named = {"gtin": box.gtin} if isinstance(box, Recognition) else {}
        boxes.append({**fields, **turned, **named})
    requests = []
    for request in order.requests:
        wanted = {"box": request.box} if request.box is not None else {"gtin": request.gtin}
        due = {} if request.due is None else {"due": request.due}
        requests.append({"at": request.arrived, **wanted, "priority": request.priority, **due})
    return {
        "pallet": order.pallet,
        "boxes": boxes,
        "requests": requests,
        "tolerance": order.tolerances.overlap,
        "order": [departure.box for departure in order.departures],
        "times": [departure.at for departure in order.departures],
    }
