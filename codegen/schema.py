"""The JSON schema of scene files, from the record that reads them.

The file ``codegen/scenes/schema.json`` is this schema; a test compares them. An editor that knows
TOML completes and checks a scene whose first line is ``#:schema`` and the path of that file.
"""

from __future__ import annotations

import json
from typing import Any

from rodproof.codegen import scene
from rodproof.codegen.scene import Key


def schema() -> dict[str, Any]:
    """The schema as data."""
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A scene of rodproof",
        "type": "object",
        "required": ["name"],
        "additionalProperties": False,
        "properties": {name: _property(key) for name, key in scene.keys().items()},
    }


def text() -> str:
    """The schema as the committed file has it."""
    return json.dumps(schema(), indent=2) + "\n"


def _property(key: Key) -> dict[str, Any]:
    said = {"description": key.doc}
    if key.kind == "names":
        entries = {"enum": list(key.allowed)}
        return said | {"type": "array", "items": entries, "uniqueItems": True}
    if key.kind == "ranges":
        pair = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
        pairs = dict.fromkeys(key.allowed, pair)
        return said | {"type": "object", "additionalProperties": False, "properties": pairs}
    if key.kind == "numbers":
        numbers = {name: {"type": "number"} for name in key.allowed}
        return said | {"type": "object", "additionalProperties": False, "properties": numbers}
    return said | ({"enum": list(key.allowed)} if key.kind == "choice" else {"type": "string"})
