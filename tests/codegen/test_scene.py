"""Scenes are data: what a scene file may say, and the sentence for what it may not."""

from __future__ import annotations

from pathlib import Path

import pytest

from rodproof.codegen import scene
from rodproof.codegen.scene import SceneError


def test_committed_scene_is_complete() -> None:
    full = scene.committed("full_rod")
    assert full.functions == scene.FUNCTIONS
    assert full.at_limit == "raise"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            'name = "a"\nfunctons = []',
            "my.toml: key 'functons' is unknown; did you mean 'functions'?",
        ),
        ('functions = ["strains"]', "my.toml: key 'name' is missing"),
        ('name = "a"\nfunctions = ["stiffnes"]', "did you mean 'stiffness'?"),
        ('name = "a"\nfunctions = []', "scene a: functions must name at least one function"),
        ('name = "a"\nfunctions = ["loads", "loads"]', "names a function twice"),
        ('name = "a"\nfunctions = "loads"', "functions must be a list of strings, not 'loads'"),
        ('name = "a"\nfunctions = [1]', "functions must be a list of strings, not [1]"),
        ("name = 3", "name must be a string, not 3"),
        ('name = "a"\nat_limit = "rise"', "at_limit 'rise' is unknown; did you mean 'raise'?"),
        ('name = "a-b"', "scene name 'a-b' is not a Python identifier"),
        ('name = "class"', "not a Python identifier"),
        ('name = "a"\nsummary = "say \\"x\\""', "summary must be one line without quotes"),
        ("name = ", "my.toml: not TOML"),
    ],
)
def test_bad_scene_gets_one_sentence(text: str, sentence: str) -> None:
    with pytest.raises(SceneError) as caught:
        scene.parse(text, "my.toml")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_unknown_names(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="scene 'ful_rod' is unknown; did you mean 'full_rod'"):
        scene.committed("ful_rod")
    with pytest.raises(SceneError, match="No such file"):
        scene.load(tmp_path / "no.toml")
