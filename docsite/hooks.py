"""What mkdocs calls: pages that are made, not written, and where they stand in the list."""

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from docsite.commands import command_pages, commands
from docsite.gallery import exhibits, gallery_index
from docsite.interface import interface_pages
from docsite.markdown import moved
from docsite.notebook import executed, notebook_page
from modeler.core.builtin import builtin_names

ROOT = Path(__file__).resolve().parents[1]
KEPT = ("site.css", "iframe-worker/iframe-worker.js", "iframe-worker/LICENSE")
"""Files as they are. iframe-worker 1.0.4 lets the search work in a folder, without a server."""


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Lists the made pages under the sections that begin with their index."""
    made = {
        "gallery/index.md": [f"gallery/{name}.md" for name in builtin_names()],
        "commands/index.md": [f"commands/{name}.md" for name in commands()],
        "python/index.md": list(interface_pages())[1:],
    }
    for section in config.nav or []:
        for pages in section.values():
            if isinstance(pages, list) and isinstance(pages[0], str):
                pages += made.get(pages[0], [])
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the home page, the reference, the gallery and the notebooks."""
    made: dict[str, str | bytes] = {**home_pages(), **command_pages(), **interface_pages()}
    made |= gallery_pages() | notebook_pages()
    made |= {name: (ROOT / "docsite" / name).read_bytes() for name in KEPT}
    for path, content in made.items():
        files.append(File.generated(config, path, content=content))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Links to notebooks lead to the pages that show them."""
    return re.sub(r"\]\((?:\.\./)*([\w-]+)\.ipynb\)", r"](notebooks/\1.md)", markdown)


def home_pages() -> dict[str, str]:
    """The README and the pages beside it."""
    names = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md"}
    names["CHANGELOG.md"] = "changelog.md"
    pages = {}
    for name, place in names.items():
        text = moved((ROOT / name).read_text(encoding="utf-8"), "docs")
        for other, there in names.items():
            text = text.replace(f"]({other})", f"]({there})")
        pages[place] = text
    return pages


def gallery_pages() -> dict[str, str | bytes]:
    """A page and a picture of every built-in robot, and their index."""
    shown = exhibits()
    pages: dict[str, str | bytes] = {"gallery/index.md": gallery_index(shown)}
    for found in shown:
        pages[f"gallery/{found.name}.md"] = found.page
        pages[f"gallery/{found.name}.png"] = found.picture
    return pages


def notebooks() -> dict[str, Path]:
    """{page: file} of the notebooks of docs/."""
    found = sorted((ROOT / "docs").glob("*.ipynb"))
    return {f"notebooks/{path.stem}.md": path for path in found}


def notebook_pages() -> dict[str, str]:
    """Every notebook as a page."""
    return {page: notebook_page(executed(path)) for page, path in notebooks().items()}
