"""What docs/python.md shows runs as it stands there."""

import re

import pytest

from conftest import repository


def test_every_python_block_of_the_manual_runs(examples, tmp_path, monkeypatch):
    pytest.importorskip("meshio")
    text = (repository / "docs" / "python.md").read_text("utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
    assert len(blocks) >= 5
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(examples)
    names = {}
    for block in blocks:
        if "inside" not in block and "world" not in block:  # test_inside.py runs those
            exec(compile(block, "docs/python.md", "exec"), names)


def test_the_manual_names_every_public_name():
    import weaveform as wf

    text = (repository / "docs" / "python.md").read_text("utf-8")
    missing = [name for name in wf.__all__ if not re.search(rf"\b{name}\b", text)]
    assert not missing
