"""Tasks of one's own: boxes lean five degrees at the most, and the arm keeps out of a zone.

python examples/keep_to_limits.py
"""

from dataclasses import replace

from depal.app.run.job import run_job
from depal.app.run.values import Job
from depal.cell.files import find_cell
from depal.cell.tasks import read_shipped_tasks
from depal.cell.workplace import Settings
from depal.domain import (
    EURO_PALLET,
    Delivery,
    DeliveryLine,
    Gtin,
    Product,
    StackedCase,
    Zone,
)
from depal.executive.language import format_repository, parse
from depal.geometry import OrientedBox, Pose

aisle = Zone("aisle", OrientedBox(Pose((1.1, 0.65, 1.2)), (0.6, 0.1, 2.4)))  # middle, edges [m]
cell = replace(find_cell("default"), zones=(aisle,))
shipped = format_repository(read_shipped_tasks())
limited = shipped.replace(
    "limit speed cell.speed", "limit speed cell.speed, tilt 5 deg avoids aisle"
)
tea = Product(Gtin("12000900000013"), "tea", (0.28, 0.25, 0.22), 4.0)
oats = Product(Gtin("12000900000020"), "oats", (0.30, 0.25, 0.20), 5.5)
stack = (
    StackedCase(tea.gtin, (0.30, 0.0, 0.0), tea.size),
    StackedCase(oats.gtin, (0.65, 0.0, 0.0), oats.size),
)
delivery = Delivery("two boxes", EURO_PALLET, (DeliveryLine(tea, 1), DeliveryLine(oats, 1)), stack)

for name, text in (("as shipped", shipped), ("limited", limited)):
    outcome = run_job(Job(cell, delivery, (), Settings(), tasks=parse(text)))
    print(f"{name}:")
    for each in outcome.departures:
        print(f"  {each.at:5.1f} s  {each.box}  {each.fate.value}  {each.place} {each.reason}")
