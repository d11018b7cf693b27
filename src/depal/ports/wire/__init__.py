"""The ports between two processes of one machine."""
