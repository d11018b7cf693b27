"""depal: an open depalletizing cell for the back room of a supermarket."""

__version__ = "0.1.0"
