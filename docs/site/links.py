"""Every link of the built site, and that it needs no network.

MkDocs itself knows only whether a linked page exists. After the build each HTML page is read as a browser would: a link must
lead to a file of the site, an anchor to an element of that page, and pictures, styles and scripts must come from the site.
What does not is a warning with the page, the link and the nearest anchor there is, and ends a strict build with 1. Links out
to the network are left alone: whether they answer is not the documents' to promise.
"""
import difflib
import logging
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

log = logging.getLogger("mkdocs.hooks.links")

LOADED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("video", "src"), ("audio", "src"),
          ("object", "data"), ("embed", "src")}
LOADED_RELATIONS = {"stylesheet", "icon", "preload", "prefetch", "modulepreload"}


class Page(HTMLParser):
    """`anchors`: ids and names; `links`: (address, whether a browser loads it with the page)."""

    def __init__(self, text):
        super().__init__()
        self.anchors = set()
        self.links = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.anchors.update(values[key] for key in ("id", "name") if values.get(key))
        for key in ("href", "src", "data"):
            if values.get(key) is None or (key == "data" and tag != "object"):
                continue
            loaded = (tag, key) in LOADED or (tag == "link" and LOADED_RELATIONS & set(values.get("rel", "").split()))
            if tag != "link" or loaded:
                self.links.append((values[key], bool(loaded)))


def complaint(address, loaded, page, folder, pages):
    """What is wrong with a link of the page at `page`, or None."""
    parts = urlsplit(address)
    if parts.scheme or parts.netloc:
        return "is loaded over the network" if loaded and parts.scheme != "data" else None
    target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    if target.is_dir():
        target /= "index.html"
    if not target.is_relative_to(folder):
        return "leads out of the site"
    if not target.is_file():
        return "leads to no file"
    anchor = unquote(parts.fragment)
    if not anchor or target not in pages or anchor in pages[target].anchors:
        return None
    near = difflib.get_close_matches(anchor, pages[target].anchors, 1)
    return "leads to no such anchor" + (f"; the nearest is #{near[0]}" if near else "")


def broken_links(folder):
    """(number of links, ["page: link what is wrong", ...]) of the site in `folder`."""
    folder = Path(folder).resolve()
    # 404.html is served at any depth and therefore has absolute addresses
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html")) if path.name != "404.html"}
    count, broken = 0, []
    for path, page in pages.items():
        count += len(page.links)
        for address, loaded in dict.fromkeys(page.links):
            wrong = complaint(address, loaded, path, folder, pages)
            if wrong:
                broken.append(f"{path.relative_to(folder)}: the link {address} {wrong}")
    return count, broken


def on_post_build(config):
    """Warns of each broken link of the built site."""
    count, broken = broken_links(config["site_dir"])
    for line in broken:
        log.warning("%s", line)
    log.info("%d links looked at, %d broken", count, len(broken))
