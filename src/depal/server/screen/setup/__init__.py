"""The view *Set-up*: deliveries, products, settings, people, tokens, the cell."""

from depal.server.screen.setup.view import SetupView

__all__ = ["SetupView"]
