"""Collects the pages of the project, and the files that they link to, as the sources of the site.

    collect.py FOLDER    writes FOLDER/pages and FOLDER/mkdocs.yml

Pages keep their paths, so that links between them lead to the same ones here and on GitHub. A source file that a page links to
becomes a page with its text, a folder one with its files. The navigation is docs/README.md: its headings are the readers.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[2]
LINK = re.compile(r"(\]\()([^)\s]+)(\))|^(\[[^\]]+\]: )(\S+)()$", re.MULTILINE)
FENCE = re.compile(r"^(\s*```)(\w+),\w+$", re.MULTILINE)
COPIED = {".svg", ".png", ".json", ".toml", ".html", ".ipynb"}
LANGUAGES = {".rs": "rust", ".py": "python", ".h": "c", ".c": "c", ".hpp": "cpp", ".cpp": "cpp", ".mjs": "javascript", ".js": "javascript", "": "bash"}


def main(folder):
    pages = folder / "pages"
    shutil.rmtree(pages, ignore_errors=True)
    files = set(subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n"))
    # What is in the sources is no page but a part of one.
    for name in sorted(file for file in files if file.endswith(".md") and "/src/" not in file and (ROOT / file).is_file()):
        text = (ROOT / name).read_text()
        write(pages / name, FENCE.sub(r"\1\2", linked(pages, name, text, files)))
    config(folder)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def linked(pages, name, text, files):
    """The text with its links to files that are no pages leading to the pages made of them."""

    def replaced(match):
        before, target, after = (match.group(1), match.group(2), match.group(3)) if match.group(1) else (match.group(4), match.group(5), "")
        path, hash_, anchor = target.partition("#")
        if not path or ":" in path:
            return match.group(0)
        there = os.path.normpath(PurePosixPath(name).parent / path)
        return before + path_of(pages, name, path, there, files) + hash_ + anchor + after

    # What stands in fenced code is no link.
    parts = re.split(r"(^ *```.*?^ *```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if index % 2 else LINK.sub(replaced, part) for index, part in enumerate(parts))


def path_of(pages, name, path, there, files):
    """The link to what is at this path, made a page where it is none."""
    if (ROOT / there).is_dir():
        if f"{there}/README.md" in files:
            return f"{path.rstrip('/')}/README.md"
        listing(pages, there, files)
        return f"{path.rstrip('/')}/index.md"
    if there.endswith(".md"):
        return path
    if not (ROOT / there).is_file():
        raise SystemExit(f"{name}: there is no {there}")
    suffix = Path(there).suffix
    if suffix in COPIED:
        (pages / there).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / there, pages / there)
        return path
    source(pages, there)
    return f"{path}.md"


def source(pages, there):
    language = LANGUAGES.get(Path(there).suffix, "text") if not there.startswith("LICENSE") else "text"
    write(pages / f"{there}.md", f"---\nsearch:\n  exclude: true\n---\n# {there}\n\n````{language}\n{(ROOT / there).read_text()}\n````\n")


def listing(pages, there, files):
    inside = sorted(file for file in files if file.startswith(f"{there}/"))
    text = f"---\nsearch:\n  exclude: true\n---\n# {there}\n\n"
    for file in inside:
        if Path(file).suffix in LANGUAGES and (ROOT / file).is_file():
            source(pages, file)
            text += f"- [{file}]({file[len(there) + 1:]}.md)\n"
        else:
            text += f"- {file}\n"
    write(pages / there / "index.md", text)


def config(folder):
    navigation = [{"Start here": "README.md"}, {"Playground": "playground/index.html"}, {"About the playground": "docs/playground.md"}]
    for section in re.split(r"^## ", (ROOT / "docs/README.md").read_text(), flags=re.MULTILINE)[1:]:
        title, _, rest = section.partition("\n")
        entries = re.findall(r"\[([^\]]+)\]\(([^):]+\.md)\)", rest)
        navigation.append({title.strip(): [{name: os.path.normpath(f"docs/{path}")} for name, path in entries]})
    navigation.append({"More": [{"All documents": "docs/README.md"}, {"Words": "docs/glossary.md"}, {"Changes": "CHANGELOG.md"}, {"Contributing": "CONTRIBUTING.md"}]})
    settings = {"INHERIT": str(Path(__file__).parent / "mkdocs.yml"), "docs_dir": str(folder / "pages"), "site_dir": str(folder / "html"), "nav": navigation}
    # JSON is YAML.
    write(folder / "mkdocs.yml", json.dumps(settings, indent=1))
    playground = ROOT / "target/web/index.html"
    (folder / "pages/playground").mkdir(exist_ok=True)
    shutil.copy(playground, folder / "pages/playground/index.html")
    shutil.copytree(Path(__file__).parent / "assets", folder / "pages/assets/site", dirs_exist_ok=True)


main(Path(sys.argv[1]).resolve())
