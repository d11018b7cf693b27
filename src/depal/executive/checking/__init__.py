"""Finds mistakes in a repository of schemata before anything runs."""

from depal.executive.checking.check import check
from depal.executive.checking.findings import Finding, FindingKind
from depal.executive.checking.values import check_quantities

__all__ = ["Finding", "FindingKind", "check", "check_quantities"]
