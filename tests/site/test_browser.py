"""The site in a real browser: it loads, filters, shows formulas, fits a phone, works by keys."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

PAGES = ("index", "statements", "errata", "derivation", "scenes", "report", "guide")
DEEP = ("statement/hess-m3-v3", "statement/q-forms-positive-definite", "scene/full_rod")
SHOWN = "[...document.querySelectorAll('#rows tbody tr')].filter(row => row.offsetParent).length"
COUNT = "document.getElementById('count').textContent"
FLAT = """[...document.querySelectorAll('math')].filter(math => {
    const box = math.getBoundingClientRect(); return box.height < 6 || box.width < 3;
}).map(math => math.outerHTML)"""
#: What is wider than the window without scrolling inside a box of its own.
SPILLS = """[...document.querySelectorAll('body *')].filter(one =>
    one.getBoundingClientRect().right > 391 && !one.closest('.skip, .hidden, thead') &&
    !one.closest('.formula, .scroll, .wide, pre')).map(one => one.outerHTML.slice(0, 200))"""


def type_in(field: str, value: str) -> str:
    """A script that enters a value as a reader would."""
    return (
        f"document.getElementById('{field}').value = '{value}';"
        f"document.getElementById('{field}').dispatchEvent(new Event('input', {{bubbles: true}}))"
    )


@pytest.mark.parametrize("page", PAGES + DEEP)
def test_loads_in_silence_with_formulas_of_some_height(
    browser: Any, pages: Path, page: str
) -> None:
    browser.open(pages / f"{page}.html")
    assert browser.complaints() == []
    assert browser.run("document.title").endswith("rodproof")
    assert browser.run(FLAT) == []
    broken = "[...document.images].filter(image => !image.naturalWidth).map(image => image.src)"
    assert browser.run(broken) == []


@pytest.mark.parametrize("page", PAGES + DEEP)
def test_nothing_is_wider_than_a_phone(browser: Any, pages: Path, page: str) -> None:
    browser.open(pages / f"{page}.html", width=390, dark=True)
    assert browser.run("document.documentElement.scrollWidth") == 390
    assert browser.run(SPILLS) == []
    assert browser.complaints() == []


def test_the_filter(browser: Any, pages: Path, evidence: Any) -> None:
    browser.open(pages / "statements.html")
    assert browser.run(SHOWN) == len(evidence)
    refuted = [e for e in evidence if e.verdict == "refuted"]
    browser.run(type_in("verdict", "refuted"))
    assert browser.run(SHOWN) == len(refuted)
    assert browser.run(COUNT) == f"{len(refuted)} of {len(evidence)} statements"
    browser.run(type_in("section", "3.4"))
    assert browser.run(SHOWN) == sum(e.section == "3.4" for e in refuted)
    browser.run(type_in("words", "HESS u3"))
    assert browser.run(SHOWN) == 1
    assert browser.run("location.hash") == "#words=HESS+u3&section=3.4&verdict=refuted"
    browser.run(type_in("words", "no such thing"))
    assert browser.run("document.getElementById('none').offsetHeight") > 0
    browser.run("document.querySelector('#filter button').click()")
    browser.run("new Promise(done => setTimeout(done, 50))")
    assert browser.run(SHOWN) == len(evidence)
    assert browser.complaints() == []


def test_a_link_brings_its_filter(browser: Any, pages: Path, evidence: Any) -> None:
    browser.open(pages / "index.html")
    link = "document.querySelector('.cards .reading a').href"
    anchor = "#" + browser.run(link).partition("#")[2]
    browser.open(pages / "statements.html", anchor=anchor)
    assert browser.run(SHOWN) == sum(e.verdict == "reading" for e in evidence)


def test_formulas_can_be_put_away(browser: Any, pages: Path) -> None:
    browser.open(pages / "statements.html")
    tall = browser.run("document.body.scrollHeight")
    browser.run("document.getElementById('formulas').click()")
    assert browser.run("document.body.scrollHeight") < 0.8 * tall


def test_without_scripts_it_is_the_whole_table(browser: Any, pages: Path, evidence: Any) -> None:
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    try:
        browser.open(pages / "statements.html")
        assert browser.run(SHOWN) == len(evidence)
        assert browser.run("document.getElementById('filter').offsetHeight") == 0
    finally:
        browser.call("Emulation.setScriptExecutionDisabled", value=False)


def test_by_keys_and_for_screen_readers(browser: Any, pages: Path) -> None:
    browser.open(pages / "statements.html")
    browser.press("Tab", 9)
    focused = "document.activeElement"
    assert browser.run(f"{focused}.className") == "skip"
    assert browser.run(f"{focused}.getBoundingClientRect().left") >= 0
    assert browser.run(f"getComputedStyle({focused}).outlineStyle") == "solid"
    assert browser.run("document.documentElement.lang") == "en"
    for landmark in ("header", "nav[aria-label]", "main#main", "footer", "h1"):
        assert browser.run(f"document.querySelectorAll('{landmark}').length") == 1, landmark
    unnamed = "[...document.querySelectorAll('input, select')].filter(f => !f.labels.length).length"
    assert browser.run(unnamed) == 0
    assert browser.run("document.getElementById('count').getAttribute('aria-live')") == "polite"
    assert browser.run("document.querySelectorAll('form[role=search][aria-label]').length") == 1
    browser.open(pages / "index.html")
    nodes = browser.call("Accessibility.getFullAXTree")["nodes"]
    roles = {node["role"]["value"] for node in nodes if "role" in node}
    assert {"banner", "navigation", "main", "contentinfo", "table"} <= roles
