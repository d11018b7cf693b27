"""A real delivery taken apart, with and without a request for its last product."""

from depal.domain import Request
from depal.logistics import read_delivery
from depal.studies.real import unload_delivery

delivery = read_delivery("dev-000")
product = delivery.lines[-1].product
request = Request(priority=1.0, gtin=product.gtin)
for w in (0.0, 0.5, 0.9):
    result = unload_delivery(delivery, [request], w)
    print(f"w = {w}: {result.served[0]} of {result.boxes} boxes before {product.name}")
