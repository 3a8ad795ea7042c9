#!/usr/bin/env python3
"""pages.py SCANOUT ROOT: scripts/pages.py writes a page for every technique of `scanout list techniques`, with its picture;
every link on a page leads somewhere, and none shows a key of docs/."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def main():
    listed = subprocess.run([SCANOUT, "list", "techniques"], check=True, capture_output=True, text=True).stdout
    techniques = [line.split()[:2] for line in listed.splitlines()]
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.path.join(ROOT, "scripts/pages.py"), SCANOUT, folder], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
        out = pathlib.Path(folder)
        for axis, name in techniques:
            page = out / axis / f"{name}.md"
            if not page.is_file():
                wrong.append(f"{axis} {name} has no page")
                continue
            text = page.read_text()
            if f"]({name}.png)" not in text or f"# {name}" not in text:
                wrong.append(f"{page.name} does not show its technique")
            for key in re.findall(r"HARD-CASES|\[[A-Z]\w+[\d., ]*\](?!\()", text):
                wrong.append(f"{page.name} shows {key}, which only those who read the code look up")
        for page in out.rglob("*.md"):
            for target in re.findall(r"\]\(([^)]+)\)", page.read_text()):
                if not (page.parent / target).is_file():
                    wrong.append(f"{page.relative_to(out)}: there is no {target}")
    if wrong or not techniques:
        sys.exit("\n".join(wrong) or "no techniques")
    print(f"{len(techniques)} pages")


if __name__ == "__main__":
    main()
