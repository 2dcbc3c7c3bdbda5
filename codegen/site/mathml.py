"""Formulas and sentences for a page: LaTeX as MathML that browsers show without help."""

from __future__ import annotations

import html
import re
import unicodedata
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from xml.etree import ElementTree as ET

from latex2mathml.converter import convert_to_element
from markupsafe import Markup

from rodproof.codegen.document import tex

_ALIGNED = re.compile(r"\\begin\{aligned\}(.*)\\end\{aligned\}", re.DOTALL)
_TOKENS = re.compile(r"\\\\|\\[A-Za-z]+|\\.|[{}&]|[^\\{}&]+", re.DOTALL)
_DOLLAR = re.compile(r"(?<!\\)\$")
_STYLES = {
    "bold": "BOLD",
    "bold-italic": "BOLD ITALIC",
    "sans-serif": "SANS-SERIF",
    "script": "SCRIPT",
    "double-struck": "DOUBLE-STRUCK",
}
_NAMED = frozenset(("sin", "cos", "tan", "cot", "csc", "log", "exp", "det", "dim", "diag"))
_PRIMES = frozenset("′″‴'")
_LIMITS = frozenset(("lim", "sup", "inf", "max", "min"))
_RELATIONS = frozenset("=<>≤≥≠→∈+−-±∓⋅×,")
_SPACES = {"/": "0", "|": "0", "⟹": "0.7em", "⟺": "0.7em", "⇒": "0.5em", "↗": "0.28em"}
_TALL = frozenset(("mfrac", "msqrt", "mtable", "msup", "msubsup", "munder", "mover", "munderover"))
_SCRIPTS = frozenset(("msub", "msup", "msubsup", "munder", "munderover"))
_PARTS = {"mfrac": 2, "msub": 2, "msup": 2, "mover": 2, "munder": 2, "msubsup": 3, "munderover": 3}
_BIG = re.compile(r"\\[bB]igg?([lr])(?![A-Za-z])")
_WIDE = 26  # characters of LaTeX from which a formula inside a sentence may need to scroll


@cache
def display(latex: str) -> Markup:
    """A formula on its own; the LaTeX source as code where it cannot be converted."""
    return _box(latex, "block")


@cache
def inline(latex: str) -> Markup:
    """A formula inside a sentence; the LaTeX source as code where it cannot be converted."""
    found = _box(latex.strip(), "inline")
    if len(latex) < _WIDE:
        return found
    return Markup('<span class="wide">{}</span>').format(found)


def prose(text: str) -> Markup:
    """Our sentences, their formulas as MathML; what a formula is, `tex.prose` decides."""
    first, *rest = _DOLLAR.split(tex.prose(text))
    pieces = [Markup.escape(tex.unescape(first))]
    for formula, after in zip(rest[::2], rest[1::2], strict=True):
        plain = tex.unescape(after)
        words = plain.lstrip(",.;:!?)")
        mark = plain[: len(plain) - len(words)]
        whole = Markup('<span class="whole">{}{}</span>') if mark else Markup("{}{}")
        pieces += [whole.format(inline(formula), mark), Markup.escape(words)]
    return Markup("").join(pieces)


def _box(latex: str, kind: str) -> Markup:
    try:
        root = _root(latex, kind)
    except Exception:  # whatever the converter raises, a reader still gets the formula
        return Markup('<code class="latex">{}</code>').format(latex)
    return Markup(ET.tostring(root, encoding="unicode"))


def _root(latex: str, kind: str) -> ET.Element:
    """The element ``math``, without a namespace (HTML knows it), fit for MathML Core."""
    latex = _BIG.sub(lambda found: {"l": r"\left", "r": r"\right"}[found[1]], latex.strip())
    whole = _ALIGNED.fullmatch(latex)
    if whole:
        root = ET.Element("math", display=kind)
        root.append(_table(whole[1]))
    else:
        root = convert_to_element(latex, display=kind)
        root.attrib.pop("xmlns", None)
    for element in root.iter():
        _mend(element)
    for element in list(root.iter()):
        _space(element)
        _fence(element)
        _prime(element)
        if element.tag in _SCRIPTS:
            _script(element, kind)
    return root


def _table(body: str) -> ET.Element:
    """The rows of an ``aligned`` block, which the converter does not know."""
    table = ET.Element("mtable", {"class": "aligned", "displaystyle": "true"})
    for row in _split(body, "\\\\"):
        line = ET.SubElement(table, "mtr")
        for cell in _split(row, "&"):
            place = ET.SubElement(line, "mtd")
            if cell.strip():
                place.extend(convert_to_element(cell.strip(), display="block"))
    return table


def _split(body: str, mark: str) -> Iterator[str]:
    """The pieces between the marks that stand outside braces and environments."""
    depth, piece = 0, ""
    for token in _TOKENS.findall(body):
        depth += (token in ("{", r"\begin")) - (token in ("}", r"\end"))
        if token == mark and depth == 0:
            yield piece
            piece = ""
        else:
            piece += token
    yield piece


def _mend(element: ET.Element) -> None:
    """Plain characters for entities, and letters of a style for the attribute of that style."""
    if element.tag == "mi" and element.text in ("&", "{", "}"):
        raise ValueError("a mark of a table or a brace that belongs to nothing")
    if len(element) != _PARTS.get(element.tag, len(element)):
        raise ValueError(f"{element.tag} with {len(element)} parts")
    if element.text:
        element.text = html.unescape(element.text)
    if element.tag in ("mo", "mi") and element.text in _SPACES:
        element.tag = "mo"
        element.attrib.update(lspace=_SPACES[element.text], rspace=_SPACES[element.text])
    style = _STYLES.get(element.get("mathvariant", ""))
    if style and element.text:
        element.text = "".join(_styled(letter, style) for letter in element.text)
        del element.attrib["mathvariant"]


def _fence(row: ET.Element) -> None:
    """Brackets grow with what is tall only: a stretched one stands apart from its letters."""
    ends = [child for child in row if child.get("fence")]
    if ends and not any(inner.tag in _TALL for inner in row.iter()):
        for end in ends:
            end.set("stretchy", "false")


def _prime(element: ET.Element) -> None:
    """A prime is small and high by itself; as a script it would shrink twice."""
    if element.tag == "msup" and set(element[1].text or "-") <= _PRIMES:
        element[1].tag = "mo"
        element[1].attrib.update(lspace="0", rspace="0")
        element.tag = "mrow"


def _script(element: ET.Element, kind: str) -> None:
    """Limits below their operator, and relations close to their sides in small print."""
    if element.tag == "msub" and element[0].text in _LIMITS and kind == "block":
        element.tag = "munder"
    for script in element[1:]:
        for inner in script.iter("mo"):
            if inner.text in _RELATIONS:
                inner.attrib.update(lspace="0.1em", rspace="0.1em")


def _styled(letter: str, style: str) -> str:
    """The character of Unicode that is this letter in this style, or the letter itself."""
    name = unicodedata.name(letter, "").removeprefix("LATIN ").removeprefix("GREEK ")
    name = name.replace("LETTER ", "")
    for wanted in (f"MATHEMATICAL {style} {name}", f"{style} {name}"):
        try:
            return unicodedata.lookup(wanted)
        except KeyError:
            continue
    return letter


def _space(parent: ET.Element) -> None:
    """A thin space where a named function meets a letter or a number."""
    if parent.tag not in ("math", "mrow", "mtd", "msqrt", "mstyle"):
        return
    children = list(parent)
    for before, after in pairwise(children):
        if before.tag == "mo" and before.text in _RELATIONS and after.text in ("-", "−", "+"):
            after.attrib.update(form="prefix", lspace="0", rspace="0")
        named = _is_named(before) and after.tag not in ("mo", "mspace")
        if named or (_is_named(after) and before.tag not in ("mo", "mspace", "mtext")):
            parent.insert(list(parent).index(after), ET.Element("mspace", width="0.167em"))


def _is_named(element: ET.Element) -> bool:
    if element.tag in ("msup", "msub") and len(element):
        return _is_named(element[0])
    return element.tag in ("mi", "mo") and element.text in _NAMED
