"""What stands on what, and what hides what: section II-C with probabilities."""

from depal.perception.relations.chances import Chances, Slack, chances_of, relations_of

__all__ = ["Chances", "Slack", "chances_of", "relations_of"]
