"""The tables of pages that a report writes stand between two marks; what is around them is written by hand."""

import sys

END = "<!-- end of table -->"


def mark(part):
    """The line before a table of `./dev report PART`."""
    return f"<!-- table: written by ./dev report {part} -->\n"


def table(head, lines):
    """Of rows of cells."""
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
                     + ["| " + " | ".join(line) + " |" for line in lines]) + "\n"


def write_tables(document, tables, begin):
    """Puts the tables between the document's marks, in their order; None leaves one as it stands."""
    with open(document, encoding="utf-8") as file:
        parts = file.read().split(begin)
    if len(parts) != len(tables) + 1:
        sys.exit(f"{document}: has not the {len(tables)} marks that hold its tables")
    text = parts[0]
    for table_now, part in zip(tables, parts[1:]):
        before, after = part.split(END, 1)
        text += begin + (before if table_now is None else table_now) + END + after
    with open(document, "w", encoding="utf-8") as file:
        file.write(text)
