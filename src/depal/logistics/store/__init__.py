"""The store's data: products, places, deliveries, requests, and what was put where."""

from depal.logistics.store.assignment import assign_places, by_storage
from depal.logistics.store.database import IN_MEMORY, Database, newest
from depal.logistics.store.drawn import random_requests
from depal.logistics.store.local import LocalStore
from depal.logistics.store.request_book import KeptRequest, RequestState
from depal.logistics.store.stock import MovementsOf, StockProjection

__all__ = [
    "IN_MEMORY",
    "Database",
    "KeptRequest",
    "LocalStore",
    "MovementsOf",
    "RequestState",
    "StockProjection",
    "assign_places",
    "by_storage",
    "newest",
    "random_requests",
]
