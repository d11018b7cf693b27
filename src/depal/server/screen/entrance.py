"""The pages before the screen: signing in, and the first account by the one-time link.

They are plain pages with a form, so that a stranger's browser gets no socket.
"""

from depal.server.screen.markup import Markup, tag
from depal.server.screen.words import Words

SIGN_IN, FIRST, SIGN_OUT = "/api/v1/sign-in", "/api/v1/first-account", "/api/v1/sign-out"
"""Where the forms send what was typed, as JSON."""

STYLE, SCRIPT = "/screen/style.css", "/screen/entrance.js"


def sign_in_page(language: str, words: Words) -> str:
    """The page for who has an account."""
    return _page(language, words, words("enter.title"), words("enter.how"), SIGN_IN, "")


def first_page(language: str, words: Words, code: str) -> str:
    """The page for who sets the cell up.

    Args:
        language: of the page.
        words: in it.
        code: the one-time code of the link.
    """
    return _page(language, words, words("first.title"), words("first.how"), FIRST, code)


def _page(language: str, words: Words, title: str, how: str, address: str, code: str) -> str:
    first = address == FIRST
    kind = "new-password" if first else "current-password"
    form = tag(
        "form",
        tag("h1", title),
        tag("p", how, cls="quiet"),
        tag("input", type="hidden", name="code", value=code) if first else None,
        _field("name", words("person.name"), "text", "username"),
        _field("password", words("person.new_password"), "password", kind),
        tag("p", words("first.password"), cls="quiet") if first else None,
        tag(
            "p",
            id="wrong",
            role="alert",
            cls="wrong",
            data_away=words("enter.away"),
            data_expected=words("enter.expected"),
        ),
        tag("button", words("first.do" if first else "enter.do"), type="submit"),
        id="form",
        cls="card",
        data_address=address,
    )
    head = (
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"depal: {title}"),
        tag("link", rel="stylesheet", href=STYLE),
        tag("script", src=SCRIPT, defer=""),
    )
    body = tag("body", tag("main", form), cls="entrance")
    return f"<!doctype html>{tag('html', tag('head', *head), body, lang=language)}"


def _field(name: str, label: str, kind: str, complete: str) -> Markup:
    box = tag("input", type=kind, name=name, id=name, autocomplete=complete, required="")
    return tag("div", tag("label", label, for_=name), box)
