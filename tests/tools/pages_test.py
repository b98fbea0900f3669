#!/usr/bin/env python3
"""The commands of the pages run: pages_test.py BIN PYTHON [PAGE...], with the folders of the programs and of the Python module.

Of the README and each page of docs/ outside of docs/studies, the ```sh blocks run in one shell, in an empty folder where
docs, meshes and runtime link to the project's, samara is on the PATH and python3 is Debian's. A block of another language whose first line is a comment
that names a file (# pebble.toml) is saved under that name first. What takes minutes or a machine of its own stands in ```console
blocks, which are not run.
"""

import glob
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.S | re.M)
FILE = re.compile(r"\s*(?:#|//|/\*)\s*(\S+\.\w+)\b.*\n")


def script_of(text, folder):
    """The commands of a page, as one script; its files are saved into the folder, each version before the commands that follow it."""
    lines, count = ["set -e"], 0
    for language, content in BLOCK.findall(text):
        named = FILE.match(content)
        if language == "sh":
            count += 1
            lines.append(content)
        elif named and "/" not in named.group(1):
            saved = os.path.join(folder, f".block-{len(lines)}")
            with open(saved, "w", encoding="utf-8") as file:
                file.write(content)
            lines.append(f"cp {saved} {named.group(1)}")
    return "\n".join(lines), count


def run_page(page, programs, python):
    """Whether the commands of a page run, and how many blocks there are; the last lines of what they print where they do not."""
    with open(page, encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        for part in ("docs", "meshes", "runtime"):
            os.symlink(os.path.join(ROOT, part), os.path.join(folder, part))
        script, count = script_of(file.read(), folder)
        environment = os.environ | {"PATH": f"{programs}:/usr/bin:{os.environ['PATH']}", "PYTHONPATH": python, "HOME": folder,
                                    "SAMARA_CACHE": os.path.join(folder, "cache")}
        result = subprocess.run(["bash", "-xc", script], cwd=folder, env=environment, text=True, check=False,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return result.returncode == 0, count, result.stdout[-2000:]


def main(words):
    if len(words) < 3:
        sys.exit(__doc__)
    programs, python = map(os.path.abspath, words[1:3])
    pages = words[3:] or [f"{ROOT}/README.md"] + sorted(page for page in glob.glob(f"{ROOT}/docs/**/*.md", recursive=True)
                                                        if "/docs/studies/" not in page)
    failed, blocks = [], 0
    for page in pages:
        runs, count, said = run_page(page, programs, python)
        blocks += count
        name = os.path.relpath(page, ROOT)
        print(f"{name}: {count} blocks, {'run' if runs else 'FAIL'}", flush=True)
        if not runs:
            failed.append(name)
            print(said)
    if not words[3:] and blocks < 20:
        sys.exit(f"only {blocks} blocks of commands were found: the pages mark them by ```sh")
    if failed:
        sys.exit(f"the commands of these pages do not run: {', '.join(failed)}")


if __name__ == "__main__":
    main(sys.argv)
