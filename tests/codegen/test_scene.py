"""Scenes are data: what a scene file may say, and the sentence for what it may not."""

from __future__ import annotations

import tomllib
from dataclasses import fields
from pathlib import Path

import pytest

from rodproof.codegen import scene, schema
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
        (
            'name = "a"\nconstraints = ["planer"]',
            "constraint 'planer' is unknown; did you mean 'planar'",
        ),
        ('name = "a"\nfixed = { gama = 1 }', "fixed 'gama' is unknown; did you mean 'gamma'?"),
        ('name = "a"\nfixed = { p = "2" }', "my.toml: fixed must be a table of numbers"),
        ('name = "a"\nfixed = { p = true }', "my.toml: fixed must be a table of numbers"),
        ('name = "a"\nfixed = { p = -2 }', "p must be positive and finite, not -2.0"),
        ('name = "a"\ndefaults = { iota = nan }', "iota must be a finite number, not nan"),
        ('name = "a"\nfixed = { iota = 0 }', "for iota = 0 say constraints = ['achiral']"),
        ('name = "a"\nfixed = { p = 2 }\ndefaults = { p = 3 }', "p is set twice"),
        (
            'name = "a"\nconstraints = ["unshearable"]\nfixed = { zeta = 2 }',
            "zeta is no constant of a rod that is unshearable",
        ),
        ('name = "a"\nfixed = { beta = 1, eta = 1, iota = 2 }', "beta^2 eta^2 - iota^2 > 0 fails"),
        (
            'name = "a"\n[moduli]\nbending=1\ntwisting=2\nshearing=1\ndilating=2\ncoupling=3',
            "beta^2 eta^2 - iota^2 > 0 fails",
        ),
        (
            'name = "a"\nmoduli = { bending = 1 }',
            "moduli lacks twisting, shearing, dilating, coupling",
        ),
        ('name = "a"\nloads = ["n4"]', "load 'n4' is unknown; did you mean"),
        ('name = "a"\nloads = ["n1", "n1"]', "loads names a load twice"),
        (
            'name = "a"\nloads = ["n1"]\nconstraints = ["unshearable"]',
            "load n1 is none of what unshearable leaves, m1, m2, m3, n3",
        ),
        ('name = "a"\nloads = ["n1"]', "loads is a function of the strains, which are not free"),
        ('name = "a"\nlayout = "lst"', "layout 'lst' is unknown; did you mean 'last'?"),
        ('name = "a"\nprecision = "float16"', "precision 'float16' is unknown"),
        (
            'name = "a"\nconstraints = ["planar", "inextensible"]\nloads = ["n3"]',
            "load n3 is none of what",
        ),
    ],
)
def test_bad_scene_gets_one_sentence(text: str, sentence: str) -> None:
    with pytest.raises(SceneError) as caught:
        scene.parse(text, "my.toml")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_published_schema_is_that_of_the_record(root: Path) -> None:
    assert (root / "codegen/scenes/schema.json").read_text("utf-8") == schema.text()
    said = schema.schema()["properties"]
    assert list(said) == [field.name for field in fields(scene.Scene)]
    assert all(key.doc for key in scene.keys().values())


@pytest.mark.parametrize("name", scene.committed_names())
def test_committed_scenes_follow_the_schema(name: str, root: Path) -> None:
    """By hand what a validator does: known keys, entries among those listed, numbers."""
    text = (root / f"codegen/scenes/{name}.toml").read_text("utf-8")
    assert text.startswith("#:schema ./schema.json\n")
    for key, value in tomllib.loads(text).items():
        said = schema.schema()["properties"][key]
        if said.get("type") == "array":
            assert set(value) <= set(said["items"]["enum"])
        elif said.get("type") == "object":
            assert set(value) <= set(said["properties"])
        else:
            assert value in said.get("enum", [value])


def test_unknown_names(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="scene 'ful_rod' is unknown; did you mean 'full_rod'"):
        scene.committed("ful_rod")
    with pytest.raises(SceneError, match="No such file"):
        scene.load(tmp_path / "no.toml")
