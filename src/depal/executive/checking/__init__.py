"""Finds mistakes in a repository of schemata before anything runs."""

from depal.executive.checking.check import check
from depal.executive.checking.findings import Finding, FindingKind

__all__ = ["Finding", "FindingKind", "check"]
