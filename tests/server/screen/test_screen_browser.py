"""The real screen in a real browser: from the first link to an empty pallet."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browsing import (
    AXE,
    COUNT_CLICKS,
    DELIVERY,
    SMALL,
    artefacts,
    axe_script,
    browser,
    missing,
    served,
)

pytestmark = pytest.mark.slow

STEP = 0.2
"""The scripted cell's [s]; a box takes eleven of them."""

TRIES, PATIENCE = 5, 5_000.0
"""So often is a box chosen again that was not chosen within so long [ms]."""

MOST_CLICKS = 3
"""From the first link to a running delivery."""


FOCUSED = """
() => {
  const here = document.activeElement;
  if (here.matches('html, body')) return ['', ''];
  return [here.innerText || here.outerHTML.slice(0, 80), getComputedStyle(here).outlineStyle];
}
"""


class Visit:
    """What a back-room worker does, in words."""

    def __init__(self, page: Any, folder: Path) -> None:  # noqa: ANN401 - Playwright may not be there
        """Nothing yet."""
        self.page, self._folder, self._count = page, folder, 0
        self.errors: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("dialog", lambda dialog: self.errors.append(f"dialog: {dialog.message}"))

    def press(self, name: str, within: str = "body") -> None:
        """Presses a button."""
        self.page.locator(within).get_by_role("button", name=name, exact=True).click()

    def sees(self, text: str, within: str = "body") -> None:
        """Waits until a text is there."""
        self.page.locator(within).get_by_text(text).first.wait_for()

    def chooses(self, name: str, search: str) -> None:
        """Searches in a list and chooses; a click that the list moves away under is done again."""
        self.page.get_by_label("Search a product or a box").fill(search)
        button = self.page.locator(".form").get_by_role("button", name=name, exact=True)
        chosen = self.page.locator(".form .choice[aria-pressed=true]", has_text=name)
        for _ in range(TRIES):
            button.click()
            try:
                chosen.wait_for(timeout=PATIENCE)
            except Exception as error:
                if type(error).__name__ != "TimeoutError":
                    raise
            else:
                return
        raise AssertionError(f"{name} cannot be chosen")

    def mode(self, word: str) -> None:
        """Waits for a mode."""
        self.sees(word, ".summary .mode")

    def brings(self, path: Path) -> None:
        """Chooses a file."""
        with self.page.expect_file_chooser() as chooser:
            self.press("Upload a delivery", ".todo")
        chooser.value.set_files(str(path))

    def queue(self) -> list[str]:
        """The boxes in the order of the last selection."""
        found: list[str] = self.page.locator(".queue tbody th").all_inner_texts()
        return [text.split()[0] for text in found]

    def shot(self, name: str) -> None:
        """Keeps a picture."""
        self._count += 1
        path = self._folder / f"{self._count:02d}_{name}.png"
        self.page.screenshot(path=str(path), full_page=True)

    def audit(self, axe: str | None) -> None:
        """Nothing that axe calls serious or critical, and nothing that a glove would miss."""
        assert self.page.evaluate(SMALL) == []
        if axe is None:
            return
        self.page.evaluate(axe)
        found = self.page.evaluate(AXE)["violations"]
        grave = [each for each in found if each["impact"] in {"serious", "critical"}]
        told = [(each["id"], [node["html"] for node in each["nodes"]]) for each in grave]
        assert told == []


@pytest.fixture
def link(tmp_path: Path) -> Iterator[str]:
    """Of a served cell with nobody in it."""
    with served(tmp_path, STEP) as found:
        yield found


@pytest.fixture
def axe() -> str | None:
    """The text of axe; where a browser is required, it is required as well."""
    found = axe_script()
    if found is None:
        print("no axe: axe-playwright-python is not installed")  # noqa: T201 - say so
    return found


def sign_up(visit: Visit, link: str) -> None:
    """The first account."""
    visit.page.goto(link)
    visit.page.get_by_label("Name").fill("anna")
    visit.page.get_by_label("Password").fill("a password of mine")
    visit.press("Create the account")
    visit.sees("Upload a delivery", ".todo h2")


def test_a_worker_empties_a_pallet(link: str, axe: str | None, tmp_path: Path) -> None:
    """A worker empties a pallet."""
    if axe is None:
        missing("axe-playwright-python is not installed") if required() else None
    with browser(tmp_path / "profile", locale="en-GB") as context:
        context.add_init_script(COUNT_CLICKS)
        visit = Visit(context.pages[0], artefacts())
        visit.page.goto(link)
        visit.shot("first_account")
        visit.audit(axe)
        begin(visit, link, axe)
        wish(visit, axe)
        answer(visit, axe)
        exchange(visit, axe)
        hold(visit)
        visit.mode("Complete")
        visit.sees("Take the pallet away")
        visit.shot("complete")
        visit.audit(axe)
        elsewhere(visit, axe)
        narrow(visit, axe)
        in_italian(visit)
        assert visit.errors == []


def required() -> bool:
    """Whether a browser is required here."""
    import os  # noqa: PLC0415

    return "browser" in os.environ.get("DEPAL_REQUIRE", "")


def begin(visit: Visit, link: str, axe: str | None) -> None:
    """At most three clicks from the link to a running delivery."""
    sign_up(visit, link)
    visit.shot("idle")
    visit.audit(axe)
    visit.brings(DELIVERY)
    visit.press("Start tuesday-01", ".todo")
    visit.mode("Working")
    assert int(visit.page.evaluate("sessionStorage.clicks")) <= MOST_CLICKS
    visit.sees("b12", ".queue")
    visit.shot("working")
    visit.audit(axe)
    assert visit.page.locator(".plan svg").count() == 2, "without a GPU the plan is shown"


def wish(visit: Visit, axe: str | None) -> None:
    """A box in the lowest layer is asked for, and moves up; the cell waits for the wish."""
    before = visit.queue().index("b4")
    visit.press("Request a case", ".wishes .head")
    visit.chooses("Box b4", "b4")
    visit.press("Now", ".form")
    visit.shot("request_form")
    visit.audit(axe)
    visit.press("Request a case", ".form .acts")
    visit.sees("Box b4", ".wish")
    visit.page.locator(".queue tr", has_text="requested").or_(
        visit.page.locator(".queue tr.is-target", has_text="b4")
    ).first.wait_for()
    assert visit.queue().index("b4") < before
    visit.shot("requested")


def answer(visit: Visit, axe: str | None) -> None:
    """Pressed twice, answered once."""
    visit.sees("The arm cannot take box b7", ".todo h2")
    visit.mode("Held")
    visit.shot("question")
    visit.audit(axe)
    visit.page.locator(".todo").get_by_role("button", name="Taken", exact=True).dblclick()
    visit.page.locator(".todo h2").get_by_text("box b7").wait_for(state="hidden")
    assert visit.page.locator(".toast.is-refused").count() == 0


def exchange(visit: Visit, axe: str | None) -> None:
    """A trolley is full."""
    visit.sees("trolley 2 is full", ".todo h2")
    visit.mode("Waiting")
    visit.sees("exchange it now", ".trolleys")
    visit.shot("exchange")
    visit.audit(axe)
    visit.press("Done", ".todo")
    visit.mode("Working")
    assert visit.page.locator(".trolley.is-exchange").count() == 0


def hold(visit: Visit) -> None:
    """Hold and resume."""
    visit.press("Hold", ".todo")
    visit.mode("Held")
    visit.sees("Press Resume to go on", ".todo h2")
    visit.shot("held")
    visit.press("Resume", ".todo")
    visit.mode("Working")


def elsewhere(visit: Visit, axe: str | None) -> None:
    """Past and every part of the set-up."""
    visit.press("Past", ".rail")
    visit.sees("Run 1: tuesday-01")
    visit.shot("past")
    visit.audit(axe)
    visit.press("Set-up", ".rail")
    for part in ("Deliveries", "Cell", "Products", "Settings", "People", "Systems"):
        visit.press(part, ".sub")
        visit.page.locator(".view-setup .card:visible h2").first.wait_for()
        visit.shot(f"setup_{part.lower()}")
        visit.audit(axe)
    visit.press("Products", ".sub")
    visit.sees("<img src=x onerror=alert(1)> Acqua & Sali")
    visit.press("Now", ".rail")


def narrow(visit: Visit, axe: str | None) -> None:
    """On a telephone nothing sticks out."""
    visit.page.set_viewport_size({"width": 390, "height": 844})
    wide = visit.page.evaluate("document.documentElement.scrollWidth")
    visit.shot("narrow")
    visit.audit(axe)
    visit.page.set_viewport_size({"width": 1280, "height": 800})
    assert wide <= 390


def in_italian(visit: Visit) -> None:
    """The language is switched on the page."""
    visit.press("Italiano", ".rail")
    visit.sees("Porta via il pallet", ".todo h2")
    assert visit.page.evaluate("document.documentElement.lang") == "it"
    visit.shot("italian")


def test_a_file_with_problems_is_told_whole_and_queued_not_at_all(
    link: str, tmp_path: Path
) -> None:
    """A file with problems is told whole and queued not at all."""
    bad = tmp_path / "bad.json"
    text = DELIVERY.read_text("utf-8")
    bad.write_text(text.replace('"mass": 9.0', '"mass": -9.0').replace('"count": 6', '"count": 7'))
    with browser(tmp_path / "profile", locale="en-GB") as context:
        visit = Visit(context.pages[0], artefacts())
        sign_up(visit, link)
        visit.brings(bad)
        visit.sees("This file cannot be used: 2 problems", ".todo")
        assert visit.page.locator(".todo li").count() == 2
        visit.sees("Upload a delivery", ".todo h2")
        visit.brings(DELIVERY)
        visit.sees("Put the pallet in", ".todo h2")
        assert visit.page.locator(".todo li").count() == 0
        assert visit.errors == []


def test_everything_is_reached_by_keyboard_with_a_visible_focus(link: str, tmp_path: Path) -> None:
    """Everything is reached by keyboard with a visible focus."""
    with browser(tmp_path / "profile", locale="en-GB") as context:
        visit = Visit(context.pages[0], artefacts())
        page = visit.page
        page.goto(link)
        page.keyboard.type("anna")
        page.keyboard.press("Tab")
        page.keyboard.type("a password of mine")
        page.keyboard.press("Enter")
        visit.sees("Upload a delivery", ".todo h2")
        seen = [focused(page) for _ in range(20)]
        told = " ".join(name for name, _ in seen)
        for button in ("Past", "Set-up", "Upload a delivery", "Request a case", "Sign out"):
            assert button in told
        assert [name for name, outline in seen if outline == "none"] == []


def focused(page: Any) -> tuple[str, str]:  # noqa: ANN401 - Playwright may not be there
    """What the next Tab leads to, and the line around it; the page's end counts as nothing."""
    page.keyboard.press("Tab")
    name, outline = page.evaluate(FOCUSED)
    return name, outline


def test_whoever_is_not_signed_in_sees_nothing(link: str, tmp_path: Path) -> None:
    """Whoever is not signed in sees nothing."""
    start = link.split("/first", maxsplit=1)[0]
    with browser(tmp_path / "profile", locale="en-GB") as context:
        visit = Visit(context.pages[0], artefacts())
        visit.page.goto(start)
        visit.page.wait_for_url("**/sign-in")
        visit.shot("sign_in")
        for path in ("/screen/picture", "/screen/product/08000000000019"):
            assert context.request.get(f"{start}{path}").status == 401
        sign_up(visit, link)
        visit.press("Sign out", ".rail")
        visit.page.wait_for_url("**/sign-in")
        visit.page.get_by_label("Name").fill("anna")
        visit.page.get_by_label("Password").fill("not my password")
        visit.press("Sign in")
        visit.page.locator("#wrong:not(:empty)").wait_for()
        visit.page.get_by_label("Password").fill("a password of mine")
        visit.press("Sign in")
        visit.sees("Upload a delivery", ".todo h2")
