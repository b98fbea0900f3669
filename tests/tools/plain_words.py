#!/usr/bin/env python3
"""Checks that the pages and the strings of the programs use none of the words in docs/words.txt.

    plain_words.py SOURCE_FOLDER     # exit 1, with a line "file:line: word -> what to write instead" for each

Checked are docs/ without docs/studies, README.md and CONTRIBUTING.md, except their code, and the string literals of C++ and
Python sources outside tests and docs. The lines of a page are read as one text, so that a phrase may run over a line's end.
"""

import pathlib
import re
import sys

LITERAL = re.compile(r'//[^\n]*|/\*.*?\*/|#include[^\n]*|\'(?:\\.|[^\'\\\n])+\'|R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\\n])*)"', re.S)
PYTHON = re.compile(r'#[^\n]*|"""(.*?)"""|"((?:\\.|[^"\\\n])*)"|\'((?:\\.|[^\'\\\n])*)\'', re.S)
CODE = re.compile(r"^ *```.*?^ *```|`[^`\n]*`|\$\$.*?\$\$|\]\([^)]*\)", re.S | re.M)


def words_of(file: pathlib.Path) -> list[tuple[re.Pattern[str], str, str]]:
    """The patterns of the list, each with its longest part in lower case and what to write instead."""
    words = []
    for line in file.read_text().splitlines():
        if not line or line.startswith("#"):
            continue
        word, better = line.split("\t")
        pattern = r"\s+".join(re.escape(part).replace(r"\*", r"\w*") for part in word.split())
        words.append((re.compile(rf"(?<![\w-]){pattern}(?![\w-])", re.I), max(word.lower().rstrip("*").split(), key=len), better))
    return words


def blank(text: str) -> str:
    """As many spaces, with the same ends of lines."""
    return re.sub(r"[^\n]", " ", text)


def strings_of(text: str, pattern: re.Pattern[str]) -> str:
    """The source with all but its string literals blanked; literals that follow each other read as one."""
    parts, at = [], 0
    for match in pattern.finditer(text):
        kept = next((group for group in match.groups()[::-1] if group), "")
        start = match.start() + match.group().find(kept) if kept else match.end()
        between = text[at:start]
        parts.append(re.sub(r"[^\n]", " ", between) if re.fullmatch(r'[\s"fR(]*', between) else re.sub(r"[^\n]", "|", between))
        parts.append(kept.replace("\\n", "  "))
        at = start + len(kept)
    return "".join(parts) + blank(text[at:])


def main() -> int:
    source = pathlib.Path(sys.argv[1]).resolve()
    words = words_of(source / "docs" / "words.txt")
    pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").rglob("*.md"))]
    texts = [(page, CODE.sub(lambda match: blank(match.group()), page.read_text()))
             for page in pages if "studies" not in page.relative_to(source).parts]
    for room in ("runtime", "converter", "meshes", "foam-cases"):
        for file in sorted((source / room).rglob("*")):
            if file.suffix in (".cpp", ".hpp"):
                texts.append((file, strings_of(file.read_text(), LITERAL)))
            elif file.suffix == ".py":
                texts.append((file, strings_of(file.read_text(), PYTHON)))
    found = 0
    for file, text in texts:
        lower = text.lower()
        for pattern, part, better in words:
            for match in pattern.finditer(text) if part in lower else ():
                line = text.count("\n", 0, match.start()) + 1
                print(f"{file.relative_to(source)}:{line}: {' '.join(match.group().split())} -> {better}")
                found += 1
    print(f"{len(texts)} files, {found} retired words", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
