"""The HTTP API: /api/v1, for a store's system and for the screen."""

from depal.server.api.app import build_app
from depal.server.api.exposure import Exposure

__all__ = ["Exposure", "build_app"]
