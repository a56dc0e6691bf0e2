"""The search, for pages that are opened from the disk.

Browsers let such pages neither fetch the search index nor start a worker. So the index is written once more as a script, with
docs/site/offline_search.js in front, which stands in for the worker; docs/site/theme/main.html loads it from the disk only.
"""
from pathlib import Path


def on_post_build(config):
    """Writes search/offline.js beside the index of MkDocs's search."""
    search = Path(config["site_dir"]) / "search"
    stand_in = Path(__file__).with_name("offline_search.js").read_text(encoding="utf-8")
    index = (search / "search_index.json").read_text(encoding="utf-8")
    (search / "offline.js").write_text(f"{stand_in}\nvar __search = {{index: Promise.resolve({index})}};\n", encoding="utf-8")
