"""Finds mistakes in a repository of schemata before anything runs."""

from depal.executive.checking.bounds import check_quantities, check_zones
from depal.executive.checking.check import check
from depal.executive.checking.findings import Finding, FindingKind

__all__ = ["Finding", "FindingKind", "check", "check_quantities", "check_zones"]
