"""The operator's screen."""

from depal.server.screen.pages import attach

__all__ = ["attach"]
