"""Deliveries and requests as files: read once at the edge, checked as a whole, then trusted."""

from depal.logistics.reading import deliveries_in, read_deliveries, read_delivery
from depal.logistics.requests import check_requests, read_requests
from depal.logistics.schemas import delivery_schema, requests_schema
from depal.logistics.shipped import shipped_deliveries

__all__ = [
    "check_requests",
    "deliveries_in",
    "delivery_schema",
    "read_deliveries",
    "read_delivery",
    "read_requests",
    "requests_schema",
    "shipped_deliveries",
]
