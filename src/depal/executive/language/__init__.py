"""The language of task files: text into a repository of schemata, and back.

    fact Box.taken : flag
    task take(Box) until Box.taken
      - kr60_grasp(Box)
    action kr60_grasp(Box) until Box.taken sets Box.taken

The paper's own notation, `schema(m, l, p)`, is read too.
"""

from depal.executive.language.condition_text import format_condition
from depal.executive.language.files import read_tasks
from depal.executive.language.formatter import format_repository, format_schema
from depal.executive.language.parser import digest_of, parse, parse_all, parse_term

__all__ = [
    "digest_of",
    "format_condition",
    "format_repository",
    "format_schema",
    "parse",
    "parse_all",
    "parse_term",
    "read_tasks",
]
