#!/usr/bin/python3
"""Builds the site of the documentation from the project's pages: make_site.py OUT, from the project's folder.

OUT/source gets a copy of every page, with the pictures and files that they link to; a page for each command, from its --help; and
the reference of the Python module, from its docstrings. Sphinx makes OUT/html of them and fails on a warning, such as a link that
leads nowhere. Doxygen's pages of the C++ interface are expected in OUT/cpp. Needs the programs in build/release/bin.
"""

import glob
import os
import re
import shutil
import subprocess
import sys

ROOT = os.getcwd()
BIN = os.path.join(ROOT, "build/release/bin")
# The order of the folders in the list of pages; within a folder it is that of docs/README.md.
PARTS = {"start": "Start", "tutorials": "Tutorials", "how-to": "How to", "reference": "Reference", "explanation": "Explanation",
         "studies": "Studies"}
LINK = re.compile(r"(!?\[(?:[^][]|\[[^]]*\])*\])\((?![a-z]+:)([^)\s#]*)(#[^)\s]*)?\)")
FENCE = re.compile(r"(^```.*?^```)", re.S | re.M)
LARGEST_COPY = 3_000_000  # bytes of a linked file that the site carries


def pages():
    """All pages, as paths in the project."""
    return sorted(glob.glob("docs/**/*.md", root_dir=ROOT, recursive=True) + glob.glob("*.md", root_dir=ROOT))


def place_of(path):
    """Where a file of the project stands in the site: the pages of docs/ at its top, the README as its first page."""
    if path == "README.md":
        return "index.md"
    if path.startswith("docs/"):
        return "pages.md" if path == "docs/README.md" else path.removeprefix("docs/")
    return path


def copied(text, page, known, source):
    """The text of a page with its links as the site has them; the files that it links to are copied."""
    def link(match):
        words, target, anchor = match.group(1), match.group(2), match.group(3) or ""
        if not target:
            return match.group(0)
        path = os.path.normpath(os.path.join(os.path.dirname(page), target))
        if os.path.isdir(os.path.join(ROOT, path)) and f"{path}/README.md" in known:
            path = f"{path}/README.md"
        whole = os.path.join(ROOT, path)
        if path not in known:
            if os.path.isdir(whole) or not os.path.exists(whole) or os.path.getsize(whole) > LARGEST_COPY:
                return f"{words[1:-1]} (`{path}`)" if f"`{path}`" != words[1:-1] else words[1:-1]
            os.makedirs(os.path.dirname(os.path.join(source, place_of(path))) or source, exist_ok=True)
            shutil.copyfile(whole, os.path.join(source, place_of(path)))
        return f"{words}({os.path.relpath(place_of(path), os.path.dirname(place_of(page)) or '.')}{anchor})"

    return "".join(part if FENCE.fullmatch(part) else LINK.sub(link, part) for part in FENCE.split(text))


def list_of_pages(known):
    """The pages in the order of docs/README.md, by the folder of docs/ that they are in; those it leaves out are an error."""
    with open(os.path.join(ROOT, "docs/README.md"), encoding="utf-8") as file:
        linked = [os.path.normpath(os.path.join("docs", target)) for _, target, _ in LINK.findall(file.read())]
    ordered = list(dict.fromkeys(page for page in linked if page in known))
    ordered += [page for page in known if page.startswith("docs/studies/") and page not in ordered]
    left_out = [page for page in known if page.startswith("docs/") and page not in ordered + ["docs/README.md"]]
    if left_out:
        sys.exit(f"docs/README.md has no link to {', '.join(left_out)}")
    return {part: [page for page in ordered if page.startswith(f"docs/{part}/")] for part in PARTS}


def toctree(caption, names):
    return f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(names) + "\n```\n"


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def command_pages(source):
    """A page for each command, from its --help; returns their names."""
    def help_of(*words):
        return subprocess.run([f"{BIN}/samara", *words, "--help"], check=True, capture_output=True, text=True).stdout

    commands = re.findall(r"(?m)^  ([a-z][a-z-]+) {2,}\S", help_of().split("Subcommands:")[-1])
    if len(commands) < 15:
        sys.exit(f"samara --help lists {len(commands)} commands: more are known")
    for command in commands:
        write(f"{source}/reference/commands/{command}.md", f"# samara {command}\n\n```text\n{help_of(command).strip()}\n```\n")
    return [f"commands/{command}" for command in commands]


PYTHON = """The Python module, function by function
=======================================

.. automodule:: samara

samara.plot
-----------

.. automodule:: samara.plot

samara.report
-------------

.. automodule:: samara.report
"""


def main(words):
    if len(words) != 2:
        sys.exit(__doc__)
    out = os.path.abspath(words[1])
    source, known = f"{out}/source", pages()
    shutil.rmtree(source, ignore_errors=True)
    parts = list_of_pages(known)
    commands = command_pages(source)
    for page in known:
        with open(os.path.join(ROOT, page), encoding="utf-8") as file:
            text = copied(file.read(), page, known, source)
        if page == "README.md":
            for part, caption in PARTS.items():
                text += toctree(caption, [place_of(page).removesuffix(".md") for page in parts[part]])
            text += toctree("The project", ["pages", "architecture", "pictures/README", "CONTRIBUTING", "CHANGELOG"])
        if page == "docs/reference/commands.md":
            text += toctree("Commands", commands)
        if page == "docs/reference/python.md":
            text += toctree("Python", ["python-module"])
        if page == "docs/reference/cpp.md":
            text += "\n```{raw} html\n<p><a href=\"../cpp/index.html\">All classes and functions</a></p>\n```\n"
        write(f"{source}/{place_of(page)}", text)
    write(f"{source}/reference/python-module.rst", PYTHON)
    os.makedirs(f"{source}/_static", exist_ok=True)
    os.makedirs(f"{source}/_extra", exist_ok=True)
    write(f"{source}/_static/site.css", "code.literal { overflow-wrap: anywhere; }\n")
    shutil.copyfile(os.path.join(ROOT, "build/tools/node_modules/mathjax/es5/tex-svg.js"), f"{source}/_static/tex-svg.js")
    if os.path.isdir(f"{out}/cpp"):
        os.symlink(f"{out}/cpp", f"{source}/_extra/cpp")
    shutil.copyfile(os.path.join(ROOT, "docs/site/conf.py"), f"{source}/conf.py")
    environment = os.environ | {"PYTHONPATH": os.path.join(ROOT, "build/release/python")}
    return subprocess.run(["sphinx-build", "-q", "-W", "--keep-going", "-b", "html", source, f"{out}/html"], env=environment,
                          check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv))
