"""Small pieces of LaTeX: escaping, mathematics inside prose, displays that never run over."""

from __future__ import annotations

import re
from collections.abc import Sequence

_GREEK = (
    "alpha",
    "beta",
    "gamma",
    "zeta",
    "eta",
    "iota",
    "theta",
    "varphi",
    "phi",
    "psi",
    "rho",
    "mu",
    "nu",
    "sigma",
    "eps",
    "pi",
    "tau",
    "chi",
    "delta",
    "kappa",
    "omega",
    "lambda",
)
_SPECIAL = {
    "&": r"\&",
    "%": r"\%",
    "#": r"\#",
    "$": r"\$",
    "_": r"\_",
    "{": r"\{",
    "}": r"\}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "\\": r"\textbackslash{}",
}
_MATH_WORD = re.compile(
    r"[\^_*=<>/]|^-?\d*(" + "|".join(_GREEK) + r")$|^-?[a-zA-Z]$|^[A-Za-z]\([^)]*\)$|^oo$|->"
    r"|^\{?\\[a-z]|^\|[A-Za-z]\|$|^[uvmnabgMN][123]$|^[A-Za-z](?:'+|\([^)]*)$"
    r"|^-?(?:sin|cos|tan|cot|" + "|".join(_GREEK) + r")(?:'+|'*\([^)]*)$"
)
_NUMBER = re.compile(r"-?\d+([./]\d+)?[.,;:)]*$")
_ESCAPED = re.compile("|".join(re.escape(tex) for tex in sorted(_SPECIAL.values(), key=len)[::-1]))
_OPERATORS = frozenset(("=", "!=", "<", ">", ">=", "<=", "->", "+", "-", ".", "x"))


def escape(text: str) -> str:
    """Plain text with LaTeX's special characters made harmless."""
    return "".join(_SPECIAL.get(c, c) for c in text)


def unescape(text: str) -> str:
    """The plain text that `escape` was given."""
    plain = {tex: c for c, tex in _SPECIAL.items()}
    return _ESCAPED.sub(lambda found: plain[found[0]], text)


def prose(text: str) -> str:
    """Our sentences, with formulas like `gamma^p + Q*^{p/2}` set as mathematics.

    What stands between backticks is mathematics. Outside them a run of words that look like
    mathematics becomes one formula; everything else is text.
    """
    parts = text.split("`")
    return "".join(
        f"${mathematics(part)}$" if k % 2 else _sentence(part) for k, part in enumerate(parts)
    )


def _sentence(text: str) -> str:
    out: list[str] = []
    run: list[str] = []
    for word in _words(text):
        if _is_math(word) or (run and (word in _OPERATORS or _is_operand(word, run[-1]))):
            run.append(word)
            if word[-1] in ",;:" and _is_balanced(" ".join(run)):
                _close(run, out)
            continue
        _close(run, out)
        out.append(escape(word))
    _close(run, out)
    return " ".join(out)


def _words(text: str) -> list[str]:
    """Words, with a bracketed formula kept in one piece."""
    words: list[str] = []
    depth = 0
    for word in text.split(" "):
        if depth > 0 and words:
            words[-1] += " " + word
        else:
            words.append(word)
        opened = word.count("(") + word.count("{") + word.count("[")
        depth = max(0, depth + opened - word.count(")") - word.count("}") - word.count("]"))
        if depth and not re.search(r"[\^_*=]|\w\(", words[-1]):
            depth = 0  # an ordinary parenthesis in a sentence
    return words


def _is_math(word: str) -> bool:
    core = word.strip(".,;:()")
    if (
        word in ("a", "A", "I", "by", "if", "/")
        or not core
        or ("-" in core.strip("-") and core.isalpha())
    ):
        return False
    return bool(_MATH_WORD.search(core)) and not re.search(
        r"[A-Za-z]{4,}/[a-z]{3,}|^'|'[a-z]", core
    )


def _is_operand(word: str, before: str) -> bool:
    """A number after a relation belongs to the formula."""
    return before in _OPERATORS and bool(_NUMBER.match(word))


def _is_balanced(text: str) -> bool:
    return all(text.count(a) == text.count(b) for a, b in ("()", "[]", "{}"))


def _close(run: list[str], out: list[str]) -> None:
    if not run:
        return
    text = " ".join(run)
    run.clear()
    body = text.rstrip(".,;:")
    tail = text[len(body) :]
    head = ""
    while body.startswith("(") and body.count("(") > body.count(")"):
        head, body = head + "(", body[1:]
    while body.endswith(")") and body.count(")") > body.count("("):
        tail, body = ")" + tail, body[:-1]
    out.append(f"{head}${mathematics(body)}${tail}")


def mathematics(text: str) -> str:
    """Plain-text mathematics as LaTeX: Greek names, relations, products, primes."""
    text = text.replace("**", "^").replace("Q*", "Q^{*}").replace("W*", "W^{*}")
    text = re.sub(r"(?<=\w)\*(?=\w)", " ", text)
    text = re.sub(r"([_^])(-?\d{2,}|-\d|[a-z]{3,})(?!\w)", r"\1{\2}", text)
    text = re.sub(r"\^\{\*\}\^\{?(-?[\w/]+)\}?", r"^{*\\,\1}", text)
    text = re.sub(r"(?<![A-Za-z\\])(" + "|".join(_GREEK) + r")(?![A-Za-z])", r"\\\1 ", text)
    text = text.replace("\\eps ", "\\varepsilon ")
    for plain, tex in _SIGNS:
        text = re.sub(plain, tex.replace("\\", r"\\"), text)
    text = re.sub(r"(?<![A-Za-z\\])([a-z]{3,})(?=\^)", r"\\mathrm{\1}", text)
    return re.sub(r"(?<![A-Za-z\\])([unvmabgMN])([123])(?![0-9])", r"\1_\2", text)


_SIGNS = (
    (r"->", r"\to "),
    (r"×", r"\times "),
    (r"!=", r"\neq "),
    (r">=", r"\geq "),
    (r"<=", r"\leq "),
    (r" \. ", r" \cdot "),
    (r"(?<=[\w})']) x (?=[\w(\\])", r" \times "),
    (r"(?<![A-Za-z\\])sup ", r"\sup "),
    (r"(?<![A-Za-z\\])lim_", r"\lim_"),
    (r"(?<![A-Za-z\\])int_", r"\int_"),
    (r"(?<![A-Za-z])oo(?![A-Za-z])", r"\infty "),
    (r"(?<![A-Za-z])khat(?![A-Za-z])", r"\hat k"),
    (r"(?<![A-Za-z])yhat(?![A-Za-z])", r"\hat y"),
    (r"(?<![A-Za-z\\])int ", r"\int "),
    (r"(?<![A-Za-z\\])(?=(?:sin|cos|tan|cot|log|exp)(?![a-z]))", "\\"),
)


def display(rows: Sequence[str], label: str = "") -> str:
    """A numbered display (unnumbered without a label), shrunk where a row is too wide."""
    if len(rows) > 1:
        body = r"\begin{aligned}" + " \\\\\n".join(rows) + r"\end{aligned}"
    else:
        body = rows[0].replace("&=", "=", 1).replace("&<", "<", 1).replace("&>", ">", 1)
        body = body.replace(r"&\leq", r"\leq", 1).replace(r"&\geq", r"\geq", 1)
    environment = "equation" if label else "equation*"
    mark = rf"\label{{{label}}}" if label else ""
    return (
        f"\\begin{{{environment}}}{mark}\n"
        rf"\adjustbox{{max width=0.92\linewidth}}{{$\displaystyle {body}$}}"
        f"\n\\end{{{environment}}}"
    )
