"""Who may do what: accounts, sessions, tokens, limits, and the audit log."""

from depal.server.people.accounts import Accounts, PersonView
from depal.server.people.audit import AuditLine, AuditLog
from depal.server.people.codes import Codes
from depal.server.people.limits import Limits
from depal.server.people.sessions import Sessions
from depal.server.people.tokens import Tokens, TokenView

__all__ = [
    "Accounts",
    "AuditLine",
    "AuditLog",
    "Codes",
    "Limits",
    "PersonView",
    "Sessions",
    "TokenView",
    "Tokens",
]
