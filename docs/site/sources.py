"""The site's pages: README.md, docs/ and everything that they link to, laid out as in the project.

MkDocs takes pages from one folder only. So before a build README.md, docs/*.md and, in turn, whatever the pages link to are
copied into a folder beside the site, SITE-source, at their own places; every relative link then leads where it leads in the
project. A file that a browser would not show (a scene, a header, a table) gets a page with its text, a folder without a
README.md one with its list. What the pages do not link to is not on the site. A link to nothing stays as it is: links.py finds
it in the built pages. The menu is docs/README.md's own: its headings and, below each, the documents it links to.
"""
import html
import logging
import os
import re
from pathlib import Path

log = logging.getLogger("mkdocs.hooks.sources")

FENCE = re.compile(r"^ {0,3}(```|~~~)")
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^)\s]+)(\))")
CODE_SPAN = re.compile(r"(`+)(?:(?!\1).)+\1")
RAW_LINK = re.compile(r"""\b(?:src|href)=["']([^"']+)["']""")
SHOWN_BY_BROWSERS = {".svg", ".png", ".jpg", ".jpeg", ".webp", ".gif", ".webm", ".mp4", ".html", ".pdf"}
LANGUAGES = {".toml": "toml", ".cpp": "cpp", ".hpp": "cpp", ".sh": "bash", ".py": "python", ".geo": "c", ".yml": "yaml"}
LARGEST_SHOWN = 200_000  # bytes; longer files are offered for download only


def prose_lines(text):
    """(line, whether it is prose) for each line; the others belong to fenced code."""
    fence = ""
    for line in text.splitlines(keepends=True):
        mark = FENCE.match(line)
        if mark and not fence:
            fence = mark[1]
        elif mark and mark[1] == fence:
            fence = ""
            yield line, False
            continue
        yield line, not fence


def split_link(link):
    """(path, "#anchor" or "") of a link into the project; path is empty for one within the page or out to the network."""
    path, hash_sign, anchor = link.partition("#")
    if re.match(r"[a-z][a-z0-9+.-]*:|//", path):
        return "", ""
    return path, hash_sign + anchor


def links_of(text):
    """Paths that a page links to, code left out."""
    for line, prose in prose_lines(text):
        if not prose:
            continue
        line = CODE_SPAN.sub("", line)
        for link in [m[2] for m in LINK.finditer(line)] + RAW_LINK.findall(line):
            path, _ = split_link(link)
            if path:
                yield path


def page_of(target, root):
    """Where the site shows a file or folder of the project: a path from the project's root."""
    place = target.relative_to(root)
    if target.is_dir():
        return place / ("README.md" if (target / "README.md").exists() else "index.md")
    if target.suffix == ".md" or target.suffix in SHOWN_BY_BROWSERS or target.stat().st_size > LARGEST_SHOWN:
        return place
    return place.with_name(place.name + ".md")


def with_page_links(text, folder, root):
    """The page's text with links to folders and source files turned to the pages that show them."""

    def turned(match):
        path, anchor = split_link(match[2])
        target = (folder / path).resolve()
        if not path or not target.exists() or not target.is_relative_to(root):
            return match[0]
        shown = os.path.relpath(root / page_of(target, root), folder).replace(os.sep, "/")
        return match[1] + shown + anchor + match[3]

    return "".join(LINK.sub(turned, line) if prose else line for line, prose in prose_lines(text))


def source_page(file, root):
    """A page that shows a text file."""
    place = file.relative_to(root).as_posix()
    text = file.read_text(encoding="utf-8", errors="replace")
    fence = "`" * max(3, 1 + max((len(run) for run in re.findall("`+", text)), default=0))
    return (f"---\ntitle: {file.name}\n---\n# {html.escape(place)}\n\n"
            f'<a href="{html.escape(file.name)}" download>The file itself</a>\n\n'
            f"{fence}{LANGUAGES.get(file.suffix, 'text')}\n{text.rstrip()}\n{fence}\n")


def folder_page(folder, root):
    """A page that lists a folder's files, each a link."""
    rows = [f"- [{entry.name}{'/' if entry.is_dir() else ''}]({entry.name})\n" for entry in sorted(folder.iterdir())]
    return f"---\ntitle: {folder.name}/\n---\n# {folder.relative_to(root).as_posix()}/\n\n" + "".join(rows)


def collected(root):
    """{place: text, or the file to copy} of the whole site, places from the project's root."""
    site = {}
    pages = [root / "README.md", *sorted((root / "docs").glob("*.md"))]
    seen = set(pages)

    def follow(text, folder):
        for path in links_of(text):
            target = (folder / path).resolve()
            if target.exists() and target.is_relative_to(root) and target not in seen:
                seen.add(target)
                pages.append(target)

    while pages:
        page = pages.pop()
        place = page.relative_to(root)
        if page.is_dir():
            if (page / "README.md").exists():
                follow("[](README.md)", page)
                continue
            text, folder = folder_page(page, root), page
        elif page.suffix == ".md":
            text, folder = page.read_text(encoding="utf-8"), page.parent
        else:
            site[place] = page
            if page_of(page, root) != place:
                site[page_of(page, root)] = source_page(page, root)
            continue
        follow(text, folder)
        site[page_of(page, root)] = with_page_links(text, folder, root)
    return site


def laid_out(site, folder):
    """Writes the collected files; what has not changed keeps its time, and what belongs to it no longer goes."""
    for place, content in site.items():
        target = folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        new = content.encode() if isinstance(content, str) else content.read_bytes()
        if not target.exists() or target.read_bytes() != new:
            target.write_bytes(new)
    for file in [path for path in folder.rglob("*") if path.is_file()]:
        if file.relative_to(folder) not in site:
            file.unlink()


def menu(root):
    """MkDocs's nav, read from docs/README.md: a section for each heading with documents below it."""
    sections = []
    for line, prose in prose_lines((root / "docs" / "README.md").read_text(encoding="utf-8")):
        if prose and line.startswith("## "):
            sections.append((line[3:].strip(), []))
        elif prose and sections:
            for path in links_of(line):
                target = (root / "docs" / path).resolve()
                known = [page for _, pages in sections for page in pages]
                if target.suffix == ".md" and target.exists() and (place := target.relative_to(root).as_posix()) not in known:
                    sections[-1][1].append(place)
    listed = {page for _, pages in sections for page in pages}
    for document in sorted((root / "docs").glob("*.md")):
        if document.name != "README.md" and f"docs/{document.name}" not in listed:
            log.warning("docs/README.md does not name docs/%s", document.name)
    return [{"Weaveform": "README.md"}, {"Read in this order": "docs/README.md"},
            *({title: pages} for title, pages in sections if pages)]


def on_config(config):
    """Turns MkDocs to the laid-out sources."""
    root = Path(config["config_file_path"]).resolve().parent
    folder = Path(config["site_dir"].rstrip("/") + "-source")
    folder.mkdir(parents=True, exist_ok=True)
    laid_out(collected(root), folder)
    config["docs_dir"] = str(folder)
    config["nav"] = menu(root)
    return config
