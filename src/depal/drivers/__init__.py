"""Devices that are not in this process, behind the ports."""
