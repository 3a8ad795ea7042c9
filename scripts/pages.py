#!/usr/bin/env python3
"""Writes a page for every technique, from its card, the head of its file, and its golden image.

    scripts/pages.py build/release/scanout FOLDER

FOLDER/README.md lists them; FOLDER/<axis>/<name>.md is a page, <name>.png beside it the picture.
"""
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KINDS = {"rung": "a rung: it has an error against the reference, and its axis is ordered, cheapest first",
         "effect": "an effect: where nothing calls for it, running it changes no bit",
         "model": "a model: a choice among others, none of them more right"}

KEY = r"(?:\[[A-Z]\w+(?: [\d., -]+)?\]|HARD-CASES\s[A-Z]?\d+(?:, [A-Z]?\d+)*)"


def without_keys(text):
    """Text without what only those who read the code look up: textbooks' keys, [Primer 9.4], and HARD-CASES 33."""
    text = re.sub(rf" \((?:{KEY}[;,]? ?)+\)", "", text)
    text = re.sub(rf"[;,:] {KEY}", "", text)
    text = re.sub(rf"{KEY}[;,] ", "", text)
    text = re.sub(rf" {KEY}(?=[:.])", "", text)
    return re.sub(rf"(?:^|(?<=\. )){KEY}\. ?", "", text).strip()


def comment(lines):
    """The lines of a comment as one paragraph."""
    return without_keys(" ".join(line[2:].strip() for line in lines))


def is_comment(line):
    return line.startswith("//")


def head(path, name):
    """What a technique's source says of it: the comment that its file opens with; in a table of rows the one above its row,
    if there is one."""
    lines = path.read_text().splitlines()
    row = next((i for i, line in enumerate(lines) if re.match(rf"constinit const \w+ {name}\{{", line)), 0)
    above = list(itertools.takewhile(is_comment, reversed(lines[:row]))) if path.name == "rows.cpp" else []
    return comment(reversed(above) if above else itertools.takewhile(is_comment, lines))


def source_of(card):
    """Its own file, or the table of its axis where it is no more than a row."""
    found = list((ROOT / "src").glob(f"*/{card['axis']}/{card['name']}.cpp")) or \
        list((ROOT / "src").glob(f"*/{card['axis']}/rows.cpp"))
    if len(found) != 1:
        sys.exit(f"{card['axis']} {card['name']}: {len(found)} files src/*/{card['axis']}/{card['name']}.cpp")
    return found[0]


def differing(scanout, golden, other):
    """Pixels of the golden image that are more than 2 codes from the other's."""
    done = subprocess.run([scanout, "compare", golden, other, "--max-diff", "2", "--max-pixels", "1000000", "--json"],
                          capture_output=True, text=True)
    return json.loads(done.stdout)["over_tolerance"]


def link(card, text=None):
    return f"[{text or card['name']}]({card['name']}.md)"


def page(scanout, card, axis):
    place = axis.index(card)
    golden = ROOT / f"tests/golden/{card['axis']}_{card['name']}.png"
    source = source_of(card)
    lines = [f"# {card['name']}", "", f"![{card['axis']} {card['name']}]({card['name']}.png)", "",
             f"{card['blurb']}.", "", head(source, card['name']), "",
             f"- Axis: {card['axis']}, number {place + 1} of {len(axis)}: "
             + " · ".join(f"**{c['name']}**" if c is card else link(c) for c in axis),
             f"- Kind: {KINDS[card['kind']]}", f"- Source: {card['source']}"]
    if card["may_err_more_than"]:
        others = ", ".join(link(c) for c in axis if c["name"] in card["may_err_more_than"].split())
        lines.append(f"- May err more than {others}, which are cheaper: {card['because']}")
    if card["reads"]:
        lines.append(f"- Reads of each pixel: {', '.join(card['reads'])}")
    for step, word in ((-1, "before"), (1, "after")):
        if 0 <= place + step < len(axis):
            other = axis[place + step]
            count = differing(scanout, golden, ROOT / f"tests/golden/{other['axis']}_{other['name']}.png")
            lines.append(f"- Differs from {link(other)}, the one {word} it, by more than 2 codes in {count} of the "
                         "picture's pixels")
    lines.append(f"- File: `{source.relative_to(ROOT)}`")
    return "\n".join(lines) + "\n", golden


def main():
    scanout, out = sys.argv[1], pathlib.Path(sys.argv[2])
    cards = json.loads(subprocess.run([scanout, "list", "techniques", "--json"], check=True, capture_output=True,
                                      text=True).stdout)
    axes = {}
    for card in cards:
        axes.setdefault(card["axis"], []).append(card)
    index = ["# Techniques", ""]
    for name, axis in axes.items():
        (out / name).mkdir(parents=True, exist_ok=True)
        index.append(f"- {name}: " + " · ".join(f"[{c['name']}]({name}/{c['name']}.md)" for c in axis))
        for card in axis:
            text, golden = page(scanout, card, axis)
            (out / name / f"{card['name']}.md").write_text(text)
            shutil.copy(golden, out / name / f"{card['name']}.png")
    (out / "README.md").write_text("\n".join(index) + "\n")
    print(f"{len(cards)} pages in {out}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
