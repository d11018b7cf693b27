"""A delivery of one's own, run in the simulated cell from Python.

python examples/run_three_boxes.py
"""

from depal.app.run.job import run_job
from depal.app.run.values import Job
from depal.cell.files import find_cell
from depal.cell.workplace import Settings
from depal.domain import (
    EURO_PALLET,
    Delivery,
    DeliveryLine,
    Gtin,
    Product,
    Request,
    StackedCase,
)

tea = Product(Gtin("12000900000013"), "tea", (0.40, 0.30, 0.25), 4.0)
oats = Product(Gtin("12000900000020"), "oats", (0.30, 0.30, 0.20), 5.5)
stack = (  # where each case stands on the pallet: its corner, and its edges as it stands [m]
    StackedCase(tea.gtin, (0.30, 0.10, 0.0), tea.size),
    StackedCase(tea.gtin, (0.70, 0.10, 0.0), tea.size),
    StackedCase(oats.gtin, (0.35, 0.10, 0.25), oats.size),
)
delivery = Delivery(
    "three boxes", EURO_PALLET, (DeliveryLine(tea, 2), DeliveryLine(oats, 1)), stack
)
wish = Request(priority=0.9, gtin=tea.gtin)
outcome = run_job(Job(find_cell("default"), delivery, (wish,), Settings(w=0.5)))

for departure in outcome.departures:
    print(f"{departure.at:6.1f} s  {departure.box}  {departure.fate.value}  {departure.place}")
served = next(iter(outcome.wishes))
print(f"the request for tea was served after {served.boxes_before} other boxes")
print(f"{outcome.stored} of {outcome.boxes} stored; all as it should: {outcome.whole}")
