"""Motions for the primitives: planned ahead where possible, charged where not."""
