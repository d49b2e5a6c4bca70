#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a site of the documentation: all pages of the tree, with navigation and search.

    docs/make_site.py OUTPUT

Pages are Markdown files wherever they are, as they read in the tree. What they link to beside pages
(sources, scenes, pictures) comes along; a link to a folder leads to its README, or to a list of it. The
navigation is docs/README.md's own tables, section by section, and then the rooms of the tree. mkdocs is
strict: a link that leads nowhere, an anchor that is not there or a page that the navigation does not
reach fails the build.
"""
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = {"build", "node_modules", ".git", ".cache", ".venv"}
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
SECTIONS = ("Use", "Understand", "Trust", "Develop")


def tracked_files():
    """All files of the project, by their paths from its root."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"],
                            cwd=ROOT, capture_output=True, text=True)
    if listed.returncode == 0:
        names = listed.stdout.split("\n")
    else:
        names = [str(path.relative_to(ROOT)) for path in ROOT.rglob("*")
                 if not LEFT_OUT & set(path.relative_to(ROOT).parts)]
    return {name for name in names if name and (ROOT / name).is_file()}


def normal(folder, target):
    """`target` as seen from `folder`, from the root."""
    parts = []
    for part in (PurePosixPath(folder) / target).parts:
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def title_of(text, name):
    heading = re.search(r"^# (.+)$", text, re.MULTILINE)
    return re.sub(r"[`*]", "", heading.group(1)) if heading else name


class Site:
    def __init__(self, output):
        self.files = tracked_files()
        self.folders = {str(parent) for name in self.files for parent in PurePosixPath(name).parents}
        self.pages = sorted(name for name in self.files if name.endswith(".md"))
        self.titles = {}
        self.source = output / "source"
        self.html = output / "html"
        self.output = output
        shutil.rmtree(output, ignore_errors=True)
        self.lists = set()

    def write(self):
        for page in self.pages:
            text = (ROOT / page).read_text(encoding="utf-8")
            self.titles[page] = title_of(text, page)
            self.put(page, self.with_links(page, text))
        for folder in sorted(self.lists):
            self.put_list(folder)
        config = {"site_name": "Gnomon", "docs_dir": "source", "site_dir": "html", "strict": True,
                  "theme": {"name": "readthedocs", "highlightjs": False, "navigation_depth": 3,
                            "collapse_navigation": True},
                  "use_directory_urls": False, "plugins": ["search"],
                  "markdown_extensions": ["tables", "fenced_code", "sane_lists",
                                          {"toc": {"permalink": True, "slugify": "SLUGIFY"}}],
                  "validation": {"nav": {"omitted_files": "warn", "not_found": "warn"},
                                 "links": {"not_found": "warn", "anchors": "warn",
                                           "absolute_links": "warn",
                                           "unrecognized_links": "warn"}},
                  "nav": self.navigation()}
        text = json.dumps(config, indent=1).replace('"SLUGIFY"',
                                                    "!!python/name:make_site.anchor_of")
        (self.output / "mkdocs.yml").write_text(text, encoding="utf-8")

    def put(self, name, text):
        path = self.source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def with_links(self, page, text):
        """The page's text, its links leading to what the site has."""
        folder = str(PurePosixPath(page).parent)
        lines, in_code = [], False
        for line in text.split("\n"):
            if line.startswith("```"):
                in_code = not in_code
            lines.append(line if in_code else
                         LINK.sub(lambda m: m[1] + self.link(folder, m[2]) + m[3], line))
        return "\n".join(lines)

    def link(self, folder, target):
        if "://" in target or target.startswith(("#", "mailto:")):
            return target
        path, hash_, anchor = target.partition("#")
        found = normal(folder, path)
        if found in self.files:
            if not found.endswith(".md"):
                self.copy(found)
            return target
        if found in self.folders or found == "":
            readme = f"{found}/README.md" if found else "README.md"
            if readme not in self.files:
                self.lists.add(found)
            return path.rstrip("/") + "/README.md" + hash_ + anchor
        return target  # mkdocs complains of it

    def copy(self, name):
        path = self.source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, path)

    def put_list(self, folder):
        """A page for a folder that has none."""
        names = sorted(name for name in self.files
                       if str(PurePosixPath(name).parent) == folder)
        for name in names:
            self.copy(name)
        rows = "\n".join(f"- [{PurePosixPath(name).name}]({PurePosixPath(name).name})"
                         for name in names)
        page = f"{folder}/README.md"
        self.put(page, f"# {folder}/\n\n{rows}\n")
        self.titles[page] = folder + "/"

    def navigation(self):
        """The tables of docs/README.md, then what they leave out, by folder."""
        placed = {"README.md", "docs/README.md", "CHANGELOG.md"}
        entries = [{"Gnomon": "README.md"}, {"Documentation": "docs/README.md"}]
        overview = (ROOT / "docs" / "README.md").read_text(encoding="utf-8")
        for section in SECTIONS:
            block = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", overview,
                              re.MULTILINE | re.DOTALL)
            pages = []
            for row in re.findall(r"^\|(.*?)\|", block.group(1), re.MULTILINE):
                for target in re.findall(r"\]\(([^)#\s]+)\)", row):
                    page = normal("docs", target)
                    page = page if page.endswith(".md") else page + "/README.md"
                    if page in self.titles and page not in placed:
                        placed.add(page)
                        pages.append({self.titles[page]: page})
            entries.append({section: pages})
        entries.append({"Changes": "CHANGELOG.md"})
        rest = {}
        for page in sorted(set(self.titles) - placed):
            rest.setdefault(page.split("/")[0], []).append({self.titles[page]: page})
        entries.append({"The tree": [{folder: pages} for folder, pages in rest.items()]})
        return entries


def anchor_of(heading, separator):
    """As GitHub makes them, since pages are read there, too."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", separator)


def main():
    if len(sys.argv) != 2:
        print("usage: docs/make_site.py OUTPUT", file=sys.stderr)
        return 2
    site = Site(Path(sys.argv[1]).resolve())
    site.write()
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "-f",
                           site.output / "mkdocs.yml"],
                          env={"PYTHONPATH": str(Path(__file__).parent), "PATH": "/usr/bin:/bin"})
    if done.returncode == 0:
        print(f"{len(site.titles)} pages: {site.html}/index.html; search works where they are served, "
              f"as by python3 -m http.server -d {site.html}")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
