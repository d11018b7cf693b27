"""Paths: straight ones near boxes, any in free space."""
