"""What mkdocs calls: pages that are made, not written, and where they stand in the list."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from docsite.commands import command_pages, commands
from docsite.effects import effects_index, portraits
from docsite.gallery import exhibits, gallery_front, gallery_index
from docsite.interface import interface_pages
from docsite.notebook import last_run, notebook_page
from docsite.schemas import schema_files
from modeler.core.choices import list_builtin_robots
from modeler.effects import CATALOGUE

if TYPE_CHECKING:  # tests read this file without it
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

ROOT = Path(__file__).resolve().parents[1]
KEPT = ("site.css", "iframe-worker/iframe-worker.js", "iframe-worker/LICENSE")
"""Files as they are. iframe-worker 1.0.4 lets the search work in a folder, without a server."""


def on_config(config: "MkDocsConfig") -> "MkDocsConfig":
    """Lists the made pages under the sections that begin with their index."""
    made: dict[str, list[Any]] = {
        "gallery/robots/index.md": [f"gallery/robots/{name}.md" for name in list_builtin_robots()],
        "gallery/effects/index.md": [
            {effect.id: f"gallery/effects/{effect.id}.md"} for effect in CATALOGUE
        ],
        "commands/index.md": [f"commands/{name}.md" for name in commands()],
        "python/index.md": list(interface_pages())[1:],
    }
    _list_made(config.nav or [], made)
    return config


def _list_made(nav: list[Any], made: dict[str, list[Any]]) -> None:
    """A section, at any depth, that begins with the index of made pages lists them."""
    for section in nav:
        for pages in section.values() if isinstance(section, dict) else ():
            if isinstance(pages, list):
                pages += made.get(pages[0], []) if isinstance(pages[0], str) else []
                _list_made(pages, made)


def on_files(files: "Files", config: "MkDocsConfig") -> "Files":
    """Adds the reference, the galleries and the notebooks."""
    from mkdocs.structure.files import File

    made: dict[str, str | bytes] = {**beside_pages(), **command_pages(), **interface_pages()}
    made |= gallery_pages() | notebook_pages() | schema_files()
    made |= {name: (ROOT / "docsite" / name).read_bytes() for name in KEPT}
    for path, content in made.items():
        files.append(File.generated(config, path, content=content))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Links to notebooks, and to what stands beside `docs/`, lead to the pages that show them."""
    up = "../" * page.file.src_uri.count("/")
    for name, place in BESIDE.items():
        markdown = markdown.replace(f"]({up}../{name}", f"]({up}{place}")
    return re.sub(r"\]\(((?:\.\./)*[\w/-]+)\.ipynb\)", r"](\1.md)", markdown)


BESIDE = {"CONTRIBUTING.md": "project/contributing.md", "CHANGELOG.md": "project/changelog.md"}
"""Pages of the site that stand beside `docs/` in the repository."""


def beside_pages() -> dict[str, str]:
    """The pages of `BESIDE`, their links as they are from their place on the site."""
    pages = {}
    for name, place in BESIDE.items():
        text = re.sub(r"\]\(docs/", "](../", (ROOT / name).read_text(encoding="utf-8"))
        for other, there in BESIDE.items():
            text = text.replace(f"]({other})", f"]({Path(there).name})")
        pages[place] = text
    return pages


def gallery_pages() -> dict[str, str | bytes]:
    """A page and a picture of every built-in robot and of every effect, and their indices."""
    robots, effects = exhibits(), portraits()
    pages: dict[str, str | bytes] = {
        "gallery/index.md": gallery_front(robots, effects),
        "gallery/robots/index.md": gallery_index(robots),
        "gallery/effects/index.md": effects_index(effects),
    }
    for item in robots:
        pages[f"gallery/robots/{item.name}.md"] = item.page
        pages[f"gallery/robots/{item.name}.png"] = item.picture
    for shown in effects:
        pages[f"gallery/effects/{shown.effect.id}.md"] = shown.page
        if shown.picture is not None and shown.thumbnail is not None:
            pages[f"gallery/effects/{shown.effect.id}.png"] = shown.picture
            pages[f"gallery/effects/{shown.effect.id}-small.png"] = shown.thumbnail
    return pages


def notebooks() -> dict[str, Path]:
    """{page: file} of the notebooks of docs/."""
    names = sorted((ROOT / "docs").rglob("*.ipynb"))
    return {path.relative_to(ROOT / "docs").with_suffix(".md").as_posix(): path for path in names}


def notebook_pages() -> dict[str, str]:
    """Every notebook as a page."""
    return {page: notebook_page(last_run(path)) for page, path in notebooks().items()}
