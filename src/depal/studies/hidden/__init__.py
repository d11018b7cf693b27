"""Requests for boxes that nobody has seen: the paper waits, access searches."""
