"""A product database as a folder: one JSON and a picture of each known face."""

from depal.perception.book.reading import read_book
from depal.perception.book.writing import BOOK_FILE, write_book

__all__ = ["BOOK_FILE", "read_book", "write_book"]
