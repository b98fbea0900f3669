#!/usr/bin/env python3
"""Checks that the includes of the sources run down the floors of docs/architecture.md, and that public headers include no other.

    include_floors.py SOURCE_FOLDER     # exit 1, with a line for each include that runs up or across

The floors are the rows of the page's table "Floors": what is named in a row may include the rows above it and, where a row
names several rooms, its own room alone.
"""

import pathlib
import re
import sys


def floors_of(page: str) -> dict[str, int]:
    """The floor of each room, a path below the source folder, from the ground up."""
    table = page.split("<!-- floors -->")[1].split("<!-- end of floors -->")[0]
    floors: dict[str, int] = {}
    for number, row in enumerate(line for line in table.splitlines() if line.startswith("| `")):
        for room in re.findall(r"`([^`]+)`", row.split("|")[1]):
            floors[room.rstrip("/")] = number
    return floors


def public_headers_of(source: pathlib.Path) -> set[str]:
    """What the build files install of the runtime, as code includes it."""
    names = set()
    for room in ("runtime/core", "runtime"):
        text = (source / room / "CMakeLists.txt").read_text()
        for block in re.findall(r"^samara_install_headers\(([^)]*)\)", text, re.M):
            names |= {f"samara/{room.removeprefix('runtime').lstrip('/')}/{name}".replace("//", "/") for name in block.split()}
    return names


def main() -> int:
    source = pathlib.Path(sys.argv[1]).resolve()
    floors = floors_of((source / "docs" / "architecture.md").read_text())
    public = public_headers_of(source)

    def room_of(path: str) -> str | None:
        parts = path.split("/")
        return next((room for depth in (3, 2, 1) if (room := "/".join(parts[:depth])) in floors), None)

    wrong = []
    files = [file for top in ("runtime", "meshes", "converter", "foam-cases") for file in (source / top).rglob("*") if file.suffix in (".cpp", ".hpp", ".h")]
    for file in sorted(files):
        own = file.relative_to(source).as_posix()
        room = room_of(own)
        if room is None:
            wrong.append(f"{own}: docs/architecture.md has no floor for its folder")
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            found = re.match(r'#include "([^"]+)"', line)
            if not found:
                continue
            name = found[1]
            path = "runtime/" + name.removeprefix("samara/") if name.startswith("samara/") else name
            other = room_of(path)
            if other and other != room and floors[other] >= floors[room]:
                wrong.append(f"{own}:{number}: {room} may not include {name}, which is of {other}")
            if own.replace("runtime/", "samara/", 1) in public and name.startswith("samara/") and name not in public and "version.hpp" not in name:
                wrong.append(f"{own}:{number}: is installed, but {name} is not")
    for line in wrong:
        print(line)
    print(f"{len(files)} files, {len(wrong)} includes that run up")
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    sys.exit(main())
