"""Rectangles that may be faces, and what is measured of each."""
