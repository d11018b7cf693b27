"""What can be asked of the cell: API and screen call these, and nothing else reaches it."""

from depal.server.usecases.registry import UseCase, use_cases

__all__ = ["UseCase", "use_cases"]
