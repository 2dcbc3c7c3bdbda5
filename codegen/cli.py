"""The command ``rodproof``. Each command imports what it needs, so that none waits for the rest.

Exit codes: 0 fine; 1 a verdict differs from the recorded one or is undecided; 2 usage;
3 generated files differ from what the source gives.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rodproof.codegen import show

if TYPE_CHECKING:
    from rodproof.codegen.scene import Scene
    from rodproof.derivations.records import Evidence

DIFFERENT_VERDICT, USAGE, DIFFERENT_FILES = 1, 2, 3

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Derives, proof-checks and generates code for a strain-limiting special Cosserat rod.",
)

Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Jobs = Annotated[int, typer.Option(min=1, help="Processes to check with.", show_default="cores")]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Work on this dask.distributed cluster.")
]
Section = Annotated[str | None, typer.Option(help="Only this section of the paper, as 3.1.")]
Quick = Annotated[bool, typer.Option("--quick", help="Fewer points and rounds: half a minute.")]
CORES = os.cpu_count() or 1


class Format(StrEnum):
    """How a derivation is shown."""

    text = "text"
    latex = "latex"
    json = "json"


def main() -> None:
    """The console script."""
    for library in ("OPENBLAS", "OMP", "MKL"):  # times are for one thread; 6x6 needs no more
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    app()


@contextmanager
def one_sentence(
    refused: tuple[type[Exception], ...] = (ValueError, OSError),
) -> Iterator[None]:
    """Bad input, or another of these errors, ends in one sentence on standard error, code 2."""
    try:
        yield
    except refused as error:
        said = str(error)
        if isinstance(error, OSError) and error.filename:
            said = f"{error.filename}: {error.strerror}"
        typer.echo(said, err=True)
        raise typer.Exit(USAGE) from None


@app.command()
def run(as_json: Json = False, jobs: Jobs = CORES) -> None:
    """Derive, check, generate, document and measure; then say what came out and where it lies."""
    from rodproof.codegen import pipeline, places, summary
    from rodproof.derivations import ledger

    with one_sentence():
        here = places.checkout()
    outcome = pipeline.run(here, jobs, lambda name: show.progress(name, kept=True))
    rows = summary.rows(outcome, here)
    if as_json:
        show.as_json([row.__dict__ for row in rows])
    else:
        show.table(("", "outcome", "where"), [(row.stage, row.outcome, row.where) for row in rows])
    _fail_on(show.differences(outcome.evidence, ledger.recorded()))


@app.command()
def derive(
    labels: Annotated[
        list[str] | None, typer.Argument(help="All of them if none is named.")
    ] = None,
    form: Annotated[Format, typer.Option("--format")] = Format.text,
    as_json: Json = False,
) -> None:
    """Show derived objects and the steps that lead to them."""
    from rodproof.codegen import explain
    from rodproof.derivations import chapters

    with one_sentence():
        found = [chapters.derive(label) for label in labels or chapters.labels()]
    if as_json or form is Format.json:
        show.as_json(explain.data(found))
    else:
        typer.echo(explain.latex(found) if form is Format.latex else explain.text(found))


@app.command()
def check(
    ids: Annotated[
        list[str] | None, typer.Argument(help="All statements if none is named.")
    ] = None,
    section: Section = None,
    as_json: Json = False,
    mutants: Annotated[bool, typer.Option("--mutants", help="Try the broken twins too.")] = False,
    jobs: Jobs = CORES,
    scheduler: Scheduler = None,
) -> None:
    """Verdict, method and time for each printed statement."""
    from rodproof.derivations import ledger, workers

    with one_sentence():
        chosen = ledger.find(ids) if ids else ledger.statements(section)
    started = time.perf_counter()
    with one_sentence(workers.ERRORS), show.progress("check") as tell:
        evidence = ledger.check(
            chosen, mutants=mutants, jobs=jobs, scheduler=scheduler, progress=tell
        )
    if as_json:
        show.as_json(
            {
                "totals": ledger.totals(evidence),
                "statements": [row.as_row() for row in evidence],
            }
        )
    elif len(evidence) == 1:
        show.story(evidence[0], _steps(evidence[0]))
    else:
        show.evidence_table(evidence)
        typer.echo(f"{show.totals(evidence)}; {time.perf_counter() - started:.1f} s")
    _fail_on(show.differences(evidence, ledger.recorded()))


def _steps(row: Evidence) -> tuple[tuple[str, str, str], ...]:
    """Where the derivation settles a statement."""
    from rodproof.derivations import chapters

    return tuple(
        (f"{derivation.label} {k}", derivation.steps[k - 1].title, derivation.steps[k - 1].rule)
        for derivation, k in chapters.settling(row.id, row.section)
    )


@app.command()
def errata(
    section: Section = None,
    out: Annotated[Path | None, typer.Option(help="Write it as Markdown to this file.")] = None,
    as_json: Json = False,
    jobs: Jobs = CORES,
) -> None:
    """What is wrong in print, with counterexamples and corrections, and what needs a reading."""
    from rodproof.codegen.document import errata as page
    from rodproof.codegen.files import write_text
    from rodproof.derivations import ledger

    with one_sentence():
        chosen = ledger.statements(section)
    with show.progress("check") as tell:
        evidence = ledger.check(chosen, mutants=False, jobs=jobs, progress=tell)
    if out:
        with one_sentence():
            write_text(out, page.render(evidence))
        _written([out], as_json)
    elif as_json:
        found = [row for row in evidence if row.verdict in ("refuted", "reading")]
        show.as_json([row.as_row() for row in found])
    else:
        show.errata(evidence)
    _fail_on(show.differences(evidence, ledger.recorded()))


@app.command()
def scenes(
    names: Annotated[list[str] | None, typer.Argument(help="A list if none is named.")] = None,
    as_json: Json = False,
) -> None:
    """List the scenes, or say what one needs, what it leaves out and what that saves."""
    from dataclasses import asdict

    from rodproof.codegen import scene

    with one_sentence():
        found = [scene.committed(name) for name in names or scene.committed_names()]
    if names:
        _accounts(found, as_json)
    elif as_json:
        show.as_json([asdict(entry) for entry in found])
    else:
        show.table(
            ("scene", "functions", "at the limit", "summary"),
            [(s.name, ", ".join(s.functions), s.at_limit, s.summary) for s in found],
        )


def _accounts(found: Sequence[Scene], as_json: bool) -> None:
    """What each scene leaves out and saves: operations counted, time taken here and now."""
    from rodproof.codegen import account
    from rodproof.codegen.measure import beside

    rows = []
    for entry in found:
        own = account.account(entry)
        with show.progress(entry.name) as tell:
            times = beside.beside(entry.name, tell)
        rows.append(account.data(own) | {"times": beside.data(times)})
        if not as_json:
            show.table(account.TIMED, account.timed(own, times), account.title(own))
            typer.echo(beside.NOTE)
    if as_json:
        show.as_json(rows)


@app.command()
def generate(
    names: Annotated[list[str] | None, typer.Argument(help="Scenes; all if none is named.")] = None,
    check_only: Annotated[
        bool, typer.Option("--check", help="Write nothing; show what would change, exit 3.")
    ] = False,
    own: Annotated[Path | None, typer.Option("--scene", help="A scene file of your own.")] = None,
    out: Annotated[Path | None, typer.Option(help="Where the module of --scene goes.")] = None,
    target: Annotated[
        str | None, typer.Option(help="numpy or numba, for --scene; the scene's first by default.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Rewrite generated/ from the derivation."""
    from rodproof.codegen import account, files, places, scene
    from rodproof.codegen import generate as generator
    from rodproof.derivations import ledger

    with one_sentence():
        if (own is None) != (out is None) or (own and (names or check_only)):
            raise ValueError("--scene FILE goes with --out FILE, and with nothing but --target")
        if target and not own:
            raise ValueError("--target goes with --scene; committed scenes name their targets")
        verdicts = ledger.recorded()
        if own and out:
            loaded = scene.load(own)
            wanted = target or loaded.targets[0]
            scene.known("target", wanted, tuple(scene.TARGETS))
            kernels = generator.kernels(loaded)
            files.write_text(out, generator.render(loaded, verdicts, wanted, kernels))
            _written([out], as_json)
            if not as_json:
                own_account = account.account(loaded, kernels)
                show.table(account.COLUMNS, account.table(own_account), account.title(own_account))
            return
        folder = places.checkout().generated
        chosen = [scene.committed(name) for name in names] if names else None
        if not check_only:
            _written(generator.write(folder, chosen, verdicts), as_json)
            return
        found = generator.check(folder, chosen, verdicts)
    show.file_differences(found, as_json)
    if found:
        typer.echo("to accept: rodproof generate (and delete what is stray)", err=True)
        raise typer.Exit(DIFFERENT_FILES)


@app.command()
def document(
    out: Annotated[Path | None, typer.Option(help="Folder; docs by default.")] = None,
    as_json: Json = False,
    jobs: Jobs = CORES,
) -> None:
    """Write the derivations with their verdicts as LaTeX, and the site."""
    from rodproof.codegen import document as documents
    from rodproof.codegen import places, site
    from rodproof.derivations import ledger

    with one_sentence():
        folder = out or places.checkout().documents
    with show.progress("check") as tell:
        evidence = ledger.check(ledger.statements(), mutants=False, jobs=jobs, progress=tell)
    with one_sentence():
        written = documents.write(folder, evidence)
        _written([*written, site.write(folder / "site", evidence)], as_json)


@app.command("open")
def open_site(as_json: Json = False) -> None:
    """Show the site that `rodproof document` wrote in the browser, or say where it lies."""
    import webbrowser

    from rodproof.codegen import places

    with one_sentence():
        page = places.checkout().site / "index.html"
        if not page.is_file():
            raise ValueError(f"{page} is not there yet: rodproof document")
    if as_json:
        show.as_json([str(page)])
    elif not webbrowser.open(page.as_uri()):
        typer.echo(page)


@app.command()
def equilibria(as_json: Json = False) -> None:
    """Confirm section 4 by solving: integrate, solve and continue, beside the closed forms."""
    from dataclasses import asdict

    from rodproof.codegen.measure import branches

    found = branches.confirm()
    if as_json:
        show.as_json(asdict(found))
    else:
        columns = ("problem", "closed form", "solved", "apart")
        show.table(columns, branches.rows(found))


@app.command()
def measure(
    quick: Quick = False,
    integrators: Annotated[
        bool, typer.Option("--integrators", help="Integrators of a rod in equilibrium instead.")
    ] = False,
    atlas: Annotated[
        bool, typer.Option("--atlas", help="The stability atlas instead: where it is right.")
    ] = False,
    replay: Annotated[
        str | None,
        typer.Option(metavar="SPOT", help="Compute one spot of the atlas again and show it."),
    ] = None,
    peers: Annotated[
        bool, typer.Option("--peers", help="Run time beside C, lambdify, numba, JAX and others.")
    ] = False,
    out: Annotated[
        Path | None, typer.Option(help="File; docs/report/ measurement.json or atlas.json.")
    ] = None,
    as_json: Json = False,
    jobs: Jobs = CORES,
    scheduler: Scheduler = None,
) -> None:
    """Measure error and run time of every form, to JSON; goes on where it was broken off."""
    from rodproof.codegen import places
    from rodproof.codegen.measure import atlas as atlases
    from rodproof.codegen.measure import atlas_table, survey
    from rodproof.derivations import workers

    spot = replay is not None
    kinds = {"--integrators": integrators, "--atlas": atlas, "--replay": spot, "--peers": peers}
    with one_sentence():
        _at_most_one([name for name, given in kinds.items() if given])
        if scheduler and (peers or spot):
            raise ValueError("--peers and --replay are computed here: they take no --scheduler")
    if peers:
        _measure_peers(quick, out, as_json)
        return
    if integrators:
        _measure_integrators(quick, out, as_json, jobs, scheduler)
        return
    if replay is not None:
        with one_sentence():
            rows = atlas_table.story(atlases.replay(replay))
        show.as_json(dict(rows)) if as_json else show.table(("", ""), rows)
        return
    with one_sentence(), one_sentence(workers.ERRORS):
        path = out
        if path is None:
            here = places.checkout()
            path = here.atlas(quick=quick) if atlas else here.measurement(quick=quick)
        with show.progress("atlas" if atlas else "measure", kept=True) as tell:
            if atlas:
                wanted = atlases.settings(quick=quick)
                atlases.measure(path, wanted, tell, jobs=jobs, scheduler=scheduler)
            else:
                asked = survey.settings(quick=quick)
                survey.measure(path, asked, tell, jobs=jobs, scheduler=scheduler)
    _written([path], as_json)


def _at_most_one(options: list[str]) -> None:
    if len(options) > 1:
        raise ValueError(f"{' and '.join(options)} do not go together: measure one at a time")


def _measure_peers(quick: bool, out: Path | None, as_json: bool) -> None:
    """Peers that are not installed are named; nothing is taken up again where it was broken off."""
    from rodproof.codegen import places
    from rodproof.codegen.measure import peers

    with one_sentence():
        path = out or places.checkout().report(quick=quick) / "peers.json"
        with show.progress("peers", kept=True) as tell:
            found = peers.compare((1, 10_000) if quick else (1, 10_000, 1_000_000), 7, tell)
        peers.save(found, path)
    if not as_json:
        show.table(*peers.table(found))
        show.table(("not measured", "why"), list(found.missing.items()))
    _written([path], as_json)


def _measure_integrators(
    quick: bool, out: Path | None, as_json: bool, jobs: int, scheduler: str | None
) -> None:
    """References on any workers, then the runs, which are timed, one after the other."""
    from rodproof.codegen import places
    from rodproof.codegen.measure.integrators import records, survey
    from rodproof.derivations import workers

    with one_sentence(workers.ERRORS):
        with one_sentence():
            path = out or places.checkout().integrators(quick=quick)
        with show.progress("integrators", kept=True) as tell:
            asked = records.settings(quick=quick)
            survey.measure(path, asked, tell, jobs=jobs, scheduler=scheduler)
    _written([path], as_json)


@app.command()
def report(
    quick: Annotated[bool, typer.Option("--quick", help="Of the quick measurement.")] = False,
    data: Annotated[
        Path | None, typer.Option(help="What `rodproof measure` wrote, if not by default.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder; beside the data by default.")] = None,
    as_json: Json = False,
) -> None:
    """Draw pages of measurements and of the atlas, without measuring; pictures of the rod."""
    from rodproof.codegen import pictures, places
    from rodproof.codegen.measure import report as reports

    with one_sentence():
        source = data or places.checkout().report(quick=quick)
        folder = out or (source if source.is_dir() else source.parent)
        _written([*reports.drawn(source, folder), *pictures.draw(folder)], as_json)


def _written(paths: list[Path], as_json: bool) -> None:
    if as_json:
        show.as_json([str(path) for path in paths])
    else:
        for path in paths:
            typer.echo(f"wrote {path}")


def _fail_on(differences: list[str]) -> None:
    for difference in differences:
        typer.echo(difference, err=True)
    if differences:
        raise typer.Exit(DIFFERENT_VERDICT)
