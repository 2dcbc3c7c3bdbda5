"""Where the project keeps what it writes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Places:
    """The folders of a checkout."""

    root: Path

    @property
    def generated(self) -> Path:
        return self.root / "generated"

    @property
    def documents(self) -> Path:
        return self.root / "docs"

    @property
    def site(self) -> Path:
        return self.documents / "site"

    def report(self, *, quick: bool) -> Path:
        """The full report is kept with the project; a quick one is of the day and machine."""
        return self.root / "docs" / "report" / ("quick" if quick else "")

    def measurement(self, *, quick: bool) -> Path:
        return self.report(quick=quick) / "measurement.json"

    def integrators(self, *, quick: bool) -> Path:
        return self.report(quick=quick) / "integrators.json"

    def atlas(self, *, quick: bool) -> Path:
        return self.report(quick=quick) / "atlas.json"

    def shown(self, path: Path) -> str:
        """A path as a reader in the root would type it."""
        return str(path.relative_to(self.root) if path.is_relative_to(self.root) else path)


def checkout() -> Places:
    """The checkout that this package was installed from with ``pip install -e``."""
    root = Path(__file__).resolve().parent.parent
    if not (root / "pyproject.toml").is_file():
        raise ValueError(
            f"{root}: not a checkout of rodproof; say where to write with --out, or work in a "
            "clone of the project"
        )
    return Places(root)
