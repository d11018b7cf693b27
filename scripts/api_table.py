"""Writes the table of docs/api.md from the use cases: `python scripts/api_table.py`."""

from pathlib import Path

from depal.server.roles import Role
from depal.server.usecases import use_cases

PAGE = Path(__file__).resolve().parent.parent / "docs" / "api.md"

BEGIN, END = "<!-- table -->\n", "<!-- end -->\n"


def table() -> str:
    """Every use case: what it does, whether it commands, and who may."""
    rows = ["| use case | what | audited | " + " | ".join(role.value for role in Role) + " |"]
    rows.append("|" + "---|" * (3 + len(Role)))
    for case in use_cases().values():
        marks = ["yes" if case.roles is None or role in case.roles else "" for role in Role]
        audited = "yes" if case.command else ""
        rows.append(f"| `{case.name}` | {case.text} | {audited} | " + " | ".join(marks) + " |")
    return "\n".join(rows) + "\n"


def page(text: str) -> str:
    """The page with the table as it is now."""
    before, rest = text.split(BEGIN)
    return before + BEGIN + table() + END + rest.split(END)[1]


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
