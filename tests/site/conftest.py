"""A real browser, headless, over the pipe of its DevTools: nothing to install besides it."""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from rodproof.codegen import site
from rodproof.derivations import ledger
from rodproof.derivations.records import Evidence, Statement

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-dev-shm-usage", "--hide-scrollbars", "--remote-debugging-pipe",
)  # fmt: skip
#: Seconds after which a browser that says nothing is given up.
PATIENCE = 30
#: The browser reads commands from its file 3 and answers into its file 4.
LAUNCH = """
import fcntl, os, sys
ends = [fcntl.fcntl(int(end), fcntl.F_DUPFD, 10) for end in sys.argv[1:3]]
os.dup2(ends[0], 3), os.dup2(ends[1], 4)
os.execv(sys.argv[3], sys.argv[3:])
"""


class Browser:
    """Commands to a browser, and what its page logged and asked for meanwhile."""

    def __init__(self, profile: Path) -> None:
        assert CHROMIUM is not None
        commands, self._write = os.pipe()
        self._read, answers = os.pipe()
        self._process = subprocess.Popen(
            [
                *(sys.executable, "-c", LAUNCH, str(commands), str(answers)),
                *(CHROMIUM, *FLAGS, f"--user-data-dir={profile}", "about:blank"),
            ],
            pass_fds=(commands, answers), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(commands), os.close(answers)
        self._rest, self._number, self._session = b"", 0, ""
        self.events: list[dict[str, Any]] = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **parameters: object) -> dict[str, Any]:
        """The result of one command; what happens meanwhile is kept in `events`."""
        self._number += 1
        message: dict[str, object] = {
            "id": self._number, "method": method, "params": parameters,
        }  # fmt: skip
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        while (answer := self._next()).get("id") != self._number:
            self.events.append(answer)
        assert "error" not in answer, answer
        result: dict[str, Any] = answer["result"]
        return result

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._read], [], [], PATIENCE)
            assert ready, "the browser says nothing"
            piece = os.read(self._read, 1 << 20)
            assert piece, "the browser is gone"
            self._rest += piece
        line, _, self._rest = self._rest.partition(b"\0")
        found: dict[str, Any] = json.loads(line)
        return found

    def open(self, page: Path, *, width: int = 1280, dark: bool = False, anchor: str = "") -> None:
        """Load a page afresh, in a window of this width."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=900,
                  deviceScaleFactor=1, mobile=width < 600)  # fmt: skip
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])
        self.events.clear()
        self.call("Page.navigate", url="about:blank")
        self._await_load()
        self.events.clear()
        self.call("Page.navigate", url=page.as_uri() + anchor)
        self._await_load()

    def _await_load(self) -> None:
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self.events.append(self._next())

    def run(self, script: str) -> Any:
        """The value of a JavaScript expression, awaited."""
        found = self.call(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True
        )
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def press(self, key: str, code: int) -> None:
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key,
                      windowsVirtualKeyCode=code)  # fmt: skip

    def complaints(self) -> list[str]:
        """What the console said, and every address that is not a file."""
        found = []
        for event in self.events:
            told = event.get("params", {})
            if event["method"] in ("Runtime.exceptionThrown", "Log.entryAdded"):
                found.append(json.dumps(told))
            elif event["method"] == "Runtime.consoleAPICalled":
                found.append(json.dumps(told["args"]))
            elif event["method"] == "Network.requestWillBeSent":
                url = told["request"]["url"]
                found += [] if url.startswith(("file:", "about:", "data:")) else [url]
        return found

    def picture(self, path: Path, *, whole: bool = False) -> None:
        """A screenshot."""
        shot = self.call("Page.captureScreenshot", captureBeyondViewport=whole)
        path.write_bytes(base64.b64decode(shot["data"]))

    def close(self) -> None:
        self._session = ""
        try:
            self.call("Browser.close")
            self._process.wait(10)
        except (AssertionError, OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._write), os.close(self._read)


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """The browser, started once."""
    if CHROMIUM is None:
        pytest.skip("chromium is not installed")
    found = Browser(tmp_path_factory.mktemp("profile"))
    yield found
    found.close()


def evidence_of(statement: Statement) -> Evidence:
    """What a page shows of a statement, without the time that its check takes."""
    from rodproof.derivations.latex import block

    verdict = ledger.recorded()[statement.id]
    wrong = verdict == "refuted"
    return Evidence(
        statement.id, statement.section, statement.label, verdict, "exact identity", 50, 5, 0.1,
        12, 11, 1, "at gamma = 2, n1 = 3/10: 9/10 against 27/10" if wrong else None,
        block(statement.correction) if statement.correction is not None else None,
        statement.reading or None, statement.claim, statement.latex, 1.5e-67, "quadrature of `W*`",
        statement.note,
    )  # fmt: skip


@pytest.fixture(scope="session")
def evidence() -> tuple[Evidence, ...]:
    """Every statement with its recorded verdict; the checks have tests of their own."""
    return tuple(map(evidence_of, ledger.statements()))


@pytest.fixture(scope="session")
def pages(
    tmp_path_factory: pytest.TempPathFactory, evidence: Sequence[Evidence], root: Path
) -> Path:
    """The site, written once, with the report of the project beside it."""
    docs = tmp_path_factory.mktemp("docs")
    shutil.copytree(root / "docs" / "report", docs / "report", ignore=lambda *_: ["quick"])
    for name in ("guide", "examples"):
        shutil.copytree(root / "docs" / name, docs / name)
    return site.write(docs / "site", evidence).parent
