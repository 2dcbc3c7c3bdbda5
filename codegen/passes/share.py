"""Computes once what is used twice: reciprocals of constants, aliases, repeated subexpressions."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import sympy as sp

from rodproof.codegen.kernel import Assignment, Kernel, symbol
from rodproof.derivations.symbols import CONSTANTS, alpha, beta, eta, gamma, p, zeta

#: A division per point becomes a product with one of these.
DIVISORS = (alpha, beta, zeta, eta, gamma, p)


def share(kernel: Kernel) -> Kernel:
    """The kernel with constants hoisted, aliases gone and repeated subexpressions named."""
    return drop_aliases(share_repeated(merge_equal(drop_aliases(hoist_reciprocals(kernel)))))


def hoist_reciprocals(kernel: Kernel) -> Kernel:
    """``m1/alpha`` becomes ``m1*per_alpha`` with the constant ``per_alpha = 1/alpha``."""
    powers = sorted(
        {
            power
            for expr in kernel.expressions()
            for power in expr.atoms(sp.Pow)
            if power.base in DIVISORS and power.exp.is_negative
        },
        key=sp.default_sort_key,
    )
    changed = {power: symbol(f"per_{power.base}") ** (-power.exp) for power in powers}
    bases = sorted({power.base for power in powers}, key=DIVISORS.index)
    added = tuple(Assignment(f"per_{base}", 1 / base) for base in bases)
    return replace(kernel.rewrite(changed), constants=(*kernel.constants, *added))


def drop_aliases(kernel: Kernel) -> Kernel:
    """An assignment that only renames another goes away.

    Not so where a step takes its input over, as where a modulus is one: the step may have been
    given it at another scale. Hints keep their names, but nothing before the outputs uses them;
    what only a hint has another name for is called by that.
    """
    kernel = _called_as_hinted(kernel)
    hinted = kernel.vectors() | ({kernel.dyad.weight} if kernel.dyad else set())
    given = {*kernel.inputs, *(a.name for a in kernel.body if not a.step)}
    taken_over = {a.name for a in kernel.body if a.step and str(a.expr) in given}
    renamed = {
        a.symbol: a.expr for a in kernel.body if a.expr.is_Symbol and a.name in hinted - taken_over
    }
    if renamed:
        body = tuple(replace(a, expr=a.expr.xreplace(renamed)) for a in kernel.body)
        kernel = replace(kernel, body=body)
    kept_names = hinted | taken_over
    aliases = {
        a.symbol: a.expr for a in kernel.body if a.expr.is_Symbol and a.name not in kept_names
    }
    if not aliases:
        return kernel
    kept = tuple(a for a in kernel.body if a.symbol not in aliases)
    return drop_aliases(replace(kernel, body=kept).rewrite(aliases))


def _called_as_hinted(kernel: Kernel) -> Kernel:
    """Names that the form's vector only repeats give way to those in it."""
    vector = kernel.form.vector if kernel.form else ()
    own = {a.symbol for a in kernel.body if a.name not in kernel.vectors()}
    taken = {a.expr: a.symbol for a in kernel.body if a.name in vector and a.expr in own}
    if not taken:
        return kernel
    body = tuple(
        replace(a, name=taken.get(a.symbol, a.symbol).name)
        for a in kernel.body
        if a.symbol not in taken.values()
    )
    return replace(kernel, body=body).rewrite(taken)


def merge_equal(kernel: Kernel) -> Kernel:
    """Of the names of a step that stand for the same expression the first is kept."""
    first: dict[tuple[str, sp.Expr], sp.Symbol] = {}
    equal = {}
    vectors = kernel.vectors()
    for a in (a for a in kernel.body if a.name not in vectors):
        known = first.setdefault((a.step, a.expr), a.symbol)
        if known != a.symbol:
            equal[a.symbol] = known
    if not equal:
        return kernel
    kept = tuple(a for a in kernel.body if a.symbol not in equal)
    return merge_equal(drop_aliases(replace(kernel, body=kept).rewrite(equal)))


def share_repeated(kernel: Kernel) -> Kernel:
    """Function values and squares that occur twice in one step get a name of their own."""
    for step in dict.fromkeys(("", *(a.step for a in kernel.body))):
        kernel = _share_step(kernel, step)
    return kernel


def _share_step(kernel: Kernel, step: str) -> Kernel:
    inside = [a.expr for a in kernel.body if a.step == step]
    outputs = [o.expr for o in kernel.outputs] if step == "" else []
    fixed = {a.symbol for a in kernel.constants} | set(CONSTANTS)
    along = {symbol(name) ** 2 for name in kernel.dyad.vector} if kernel.dyad else set()
    if kernel.region:  # its quantity is written alike in every plain kernel
        along |= {n for a in kernel.down_to(kernel.region.quantity) for n in _nodes(a.expr)}
    counts = Counter(
        node
        for expr in (*inside, *outputs)
        for node in sp.preorder_traversal(expr)
        if _worth_a_name(node) and node not in along and not node.free_symbols <= fixed
    )
    repeated = sorted((n for n, c in counts.items() if c > 1), key=sp.default_sort_key)
    names = {
        node: symbol(f"t{k}_{step}" if step else f"t{k}") for k, node in enumerate(repeated, 1)
    }
    added = tuple(Assignment(new.name, node, (), step) for node, new in names.items())
    body = tuple(
        replace(a, expr=a.expr.xreplace(names)) if a.step == step else a for a in kernel.body
    )
    changed = tuple(
        replace(o, expr=o.expr.xreplace(names)) if step == "" else o for o in kernel.outputs
    )
    return replace(kernel, body=(*added, *body), outputs=changed)


def _nodes(expr: sp.Expr) -> set[sp.Basic]:
    return set(sp.preorder_traversal(expr))


def _worth_a_name(node: sp.Basic) -> bool:
    square = isinstance(node, sp.Pow) and node.exp == 2
    return square or isinstance(node, (sp.Function, sp.Max, sp.Min))
