"""The command line."""

from depal.cli.main import main

__all__ = ["main"]
