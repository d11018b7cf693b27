"""Deliveries and requests as files: read once at the edge, checked as a whole, then trusted."""

from depal.logistics.reading import read_deliveries, read_delivery
from depal.logistics.requests import check_requests, read_requests
from depal.logistics.schemas import delivery_schema, requests_schema
from depal.logistics.shipped import shipped_deliveries

__all__ = [
    "check_requests",
    "delivery_schema",
    "read_deliveries",
    "read_delivery",
    "read_requests",
    "requests_schema",
    "shipped_deliveries",
]
