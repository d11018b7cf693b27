"""`depal see`: what perception finds in a frame, as JSON and over the picture."""

from depal.app.see.given import Given, given
from depal.app.see.report import see_report

__all__ = ["Given", "given", "see_report"]
