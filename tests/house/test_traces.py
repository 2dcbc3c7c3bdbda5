"""No tracked file knows the machine it was written on."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

#: Home and build folders of a machine, registry settings, and links of a package to its host.
TRACES = re.compile(
    rb"(?<![\w.])/(?:home|root|work|farm|Users|opt|mnt)/\w"
    rb"|index[-_][u]rl|find[-]links|/simple/?[\"' \n]"
    rb"|\b(?:url|resolved|source)\"? *[=:] *.?https?://"
)
TEXT = {".py", ".toml", ".lock", ".md", ".cff", ".yaml", ".json", ".tex", ".txt", ".svg", ""}


def tracked(root: Path) -> list[Path]:
    done = subprocess.run(["git", "ls-files", "-z"], cwd=root, check=True, capture_output=True)
    return [root / name.decode() for name in done.stdout.split(b"\0") if name]


def test_no_tracked_file_names_this_machine(root: Path) -> None:
    here = str(root).encode()
    found = [
        f"{path.relative_to(root)}: {trace.group().decode()}"
        for path in tracked(root)
        if path.is_file() and path.suffix in TEXT
        for data in [path.read_bytes()]
        for trace in [TRACES.search(data) or re.search(re.escape(here), data)]
        if trace
    ]
    assert found == []


def test_the_pattern_sees_what_it_is_for() -> None:
    """The samples are put together here, so that this file itself stays clean."""
    folder, host, option = "/".join(["", "root", "a"]), "https" + "://host", "index" + "-url"
    for trace in (f"({folder})", f'"url": "{host}', f"--extra-{option} x"):
        assert TRACES.search(trace.encode()), trace
    assert not TRACES.search(b"my/root.toml and generated/scenes/full_rod.py")


def test_lock_pins_every_line(root: Path) -> None:
    lines = (root / "requirements.lock").read_text().splitlines()
    assert [line for line in lines if not re.fullmatch(r"[\w.-]+==[\w.]+", line)] == []
