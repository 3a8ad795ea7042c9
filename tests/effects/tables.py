#!/usr/bin/env python3
"""tables.py ROOT BUILD: `scanout explain --no-times` prints for every scene of scenes.txt the table that is kept here.

plain.txt is the table of the scene `plain`, to the letter. NAME.txt holds what the table of another scene has otherwise: the
rows, and of each the cells, that differ (- is an empty one). A part of a reason that plain has with other numbers is
`as plain: ` and the numbers; one that plain has not is written out in the first scene that has it, and `as SCENE: ` in all
others. So one changed word of a reason changes one file.

SCANOUT_UPDATE_GOLDEN=1 writes all of them anew.
"""
import concurrent.futures
import os
import re
import subprocess
import sys

import scenes

HEADS = ("effect", "runs", "memory", "codes", "FLIP", "pixels", "because")
WIDTHS = (17, 22, 8, 5, 6, 6)  # of the files that hold differences; longer cells may jut out
PICTURE, SPECIAL, PROOF = "(picture)", "(special)", "(proof)"  # the lines around the table: rows with nothing but a reason
CLAUSE = re.compile(r"(; | \(forced\))")  # what stands between the parts of a reason
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]\d+)?")


class Malformed(Exception):
    pass


def in_columns(cells, widths):
    """A line: two names to the left, numbers to the right, the reason as it is."""
    line = [f"{cell:<{width}}" if i < 2 else f"{cell:>{width}}" for i, (cell, width) in enumerate(zip(cells, widths))]
    return "  ".join((*line, cells[-1]))


def read(text, model):
    """{row: cells behind its name} of a table. Text that these cells do not give back to the letter is malformed."""
    lines = text.splitlines()
    at = next((i for i, line in enumerate(lines) if line.split() == list(HEADS)), None)
    if at not in (1, 2) or not text.endswith("\n") or not lines[0].startswith(model + "  "):
        raise Malformed("no table")
    ends = [lines[at].index(f" {head}") + 1 + len(head) for head in HEADS[2:-1]]
    reason = ends[-1] + 2
    rows = {PICTURE: ("",) * 5 + (lines[0][len(model) + 2:],)}
    if at == 2:
        rows[SPECIAL] = ("",) * 5 + (lines[1],)
    table = []
    for line in lines[at + 1:]:
        if line.startswith("switching on "):
            break  # the proof, below the table
        names = line[:ends[0]].split(None, 2)  # effect, runs, memory
        if len(names) < 3:
            raise Malformed(f"no row: {line}")
        table.append((*names, *(line[a:b].strip() for a, b in zip(ends, ends[1:])), line[reason:]))
    rest = lines[at + 1 + len(table):]
    for name, *cells in table:
        rows[name] = tuple(cells)
    if rest:
        rows[PROOF] = ("",) * 5 + (rest[0],)
    widths = [max(len(cells[i]) for cells in (HEADS, *table)) for i in range(len(HEADS) - 1)]
    if len(rest) > 1 or len(rows) != len(table) + 1 + (at == 2) + len(rest) or \
            lines[at:at + 1 + len(table)] != [in_columns(cells, widths) for cells in (HEADS, *table)]:
        raise Malformed("not laid out as a table is")
    return rows


class Reasons:
    """Which scene writes out a part of a reason: the first that has it, numbers apart, and is on every machine."""

    def __init__(self):
        self.first = {}

    def cell(self, scene, row, text, everywhere=True):
        return "".join(part if CLAUSE.match(part) else self.clause(scene, row, part, everywhere) for part in CLAUSE.split(text))

    def clause(self, scene, row, text, everywhere):
        reason = row, NUMBER.sub("#", text)
        owner = self.first.setdefault(reason, scene) if everywhere else self.first.get(reason, scene)
        return text if owner == scene else f"as {owner}: {', '.join(NUMBER.findall(text))}".rstrip(": ")


def difference(rows, plain, reason_of):
    """The text of a scene's file; reason_of(row, text) is the cell of a reason that plain has otherwise."""
    lines = [in_columns(HEADS, WIDTHS)]
    for name in [*plain, *(row for row in rows if row not in plain)]:
        if name not in rows:
            lines.append(f"{name:<{WIDTHS[0]}}  is not there")
        elif rows[name] != plain.get(name):
            old = plain.get(name, (None,) * 6)
            cells = ["" if new == before else new or "-" for new, before in zip(rows[name][:-1], old)]
            reason = "" if rows[name][-1] == old[-1] else reason_of(name, rows[name][-1])
            lines.append(in_columns((name, *cells, reason), WIDTHS).rstrip())
    return "\n".join(lines) + "\n"


def explained(scanout, arguments):
    done = subprocess.run([scanout, "explain", *arguments, "--no-times"], capture_output=True, text=True)
    if done.returncode != 0:
        raise Malformed(f"exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def files(texts, models):
    """{scene: text of its file}, from {scene: table} and {scene: path of its model in scenes.txt}; plain is the first."""
    reasons, written = Reasons(), {}
    for scene, text in texts.items():
        try:
            rows = read(text, os.path.basename(models[scene]))
        except Malformed as fault:
            raise Malformed(f"{scene}: {fault}\n{text}") from fault
        if scene == "plain":
            plain, written[scene] = rows, text
            for name, cells in rows.items():
                reasons.cell(scene, name, cells[-1])
        else:
            everywhere = not models[scene].startswith("assets/")
            written[scene] = difference(rows, plain, lambda row, text: reasons.cell(scene, row, text, everywhere))
    return written


def main():
    root, build = (os.path.abspath(path) for path in sys.argv[1:3])
    arguments = {name: scenes.arguments(root, os.path.join(build, "effects"), name) for name in scenes.rows()}
    here = {name: words for name, words in arguments.items() if words is not None}
    if next(iter(here), None) != "plain":
        scenes.fail("the first scene is not plain")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        texts = dict(zip(here, pool.map(lambda words: explained(os.path.join(build, "scanout"), words), here.values())))
    try:
        written = files(texts, {name: model for name, (model, _) in scenes.rows().items()})
    except Malformed as fault:
        scenes.fail(fault)
    wrong = []
    for name, text in written.items():
        path = os.path.join(scenes.FOLDER, name + ".txt")
        kept = open(path).read() if os.path.exists(path) else ""
        if text == kept:
            continue
        if os.environ.get("SCANOUT_UPDATE_GOLDEN") == "1":
            with open(path, "w") as file:
                file.write(text)
            print(f"{name}.txt is written anew")
        else:
            wrong.append(f"{name}: explain prints\n{texts[name]}so {path} would be\n{text}and is\n{kept}")
    known = {name + ".txt" for name in arguments} | {"scenes.txt"}
    wrong += [f"{name} belongs to no scene" for name in os.listdir(scenes.FOLDER) if name.endswith(".txt") and name not in known]
    if wrong:
        scenes.fail(*wrong)
    print(f"{len(written)} tables, {len(arguments) - len(here)} models are not on this machine")


if __name__ == "__main__":
    main()
