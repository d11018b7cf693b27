"""Secrets are kept as digests: who reads the database cannot use them."""

import hashlib


def digest_of(secret: str) -> str:
    """SHA-256 of a secret that is random and long: it needs no salt."""
    return hashlib.sha256(secret.encode()).hexdigest()
