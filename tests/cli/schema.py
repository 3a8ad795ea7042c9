#!/usr/bin/env python3
"""schema.py SCANOUT ROOT: every JSON that the program writes is as docs/report.schema.json says, which has a definition for each."""
import json
import os
import subprocess
import sys
import tempfile

import jsonschema

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SPOT, SPIDER = "models/spot/spot.obj", "models/spider/spider.obj"
LISTS = ("techniques", "formats", "targets", "keys", "options", "displays", "connectors", "modes", "renderers")
# (definition, command line)
REPORTS = [
    ("render", ["render", SPOT, "--json", "-s", "64x48", "--frames", "2"]),
    ("render", ["render", SPOT, "--json", "-s", "32x24", "--reference", "--reference-samples", "16"]),
    ("render", ["render", SPOT, "--json", "-s", "64x48", "--max-error", "30", "--samples", "1", "--quiet"]),
    ("render", ["render", SPOT, "--json", "-s", "64x48", "--measure", "0,0,0:1,0,0:1,1,0", "--quiet"]),
    ("renders", ["render", SPOT, SPIDER, "--json", "-s", "64x48"]),
    ("render", ["view", SPOT, "--backend", "headless", "--replay", "models/spot/turn.actions", "-s", "64x48", "--json"]),
    ("explain", ["explain", SPOT, "--json", "-s", "64x48"]),
    ("explain", ["explain", SPIDER, "--json", "-s", "64x48", "--no-times", "--effect", "texture=off", "--shadow", "volume"]),
    ("explain", ["explain", "models/cornell_box/cornell_box.obj", "--json", "-s", "64x48", "--light", "point:278,500,280:size=30"]),
    ("compare", ["compare", "models/spot/spot-by-scanout.png", "models/spot/spot-by-scanout.png", "--json"]),
    ("compare", ["compare", "models/spot/spot-by-scanout.png", "models/spot/spot-by-scanout.png", "--json", "--metric", "psnr", "--limit", "3"]),
    ("info", ["info", SPOT, "--json"]),
    ("info", ["info", SPIDER, "--json"]),
    ("info", ["info", "wires.obj", "--json"]),
    ("doctor", ["doctor", SPIDER, "--json", "-s", "64x48", "--fix", "mended.obj"]),
    ("doctor", ["doctor", "models/angle_block/angle_block.stl", "--json", "-s", "64x48", "--quick"]),
    ("frontier", ["frontier", SPOT, "--json", "-s", "64x48", "--quick", "--seconds", "2", "--axis", "aa", "--axis", "texture"]),
    ("frontier", ["frontier", SPOT, "--json", "-s", "64x48", "--no-times", "--axis", "aa"]),
    *[(f"list_{what}", ["list", what, "--json"]) for what in LISTS],
]


def check(schema, name, report):
    """What is wrong with a report; None where nothing is."""
    wanted = {**schema, "$ref": f"#/$defs/{name}"}
    errors = sorted(jsonschema.Draft202012Validator(wanted).iter_errors(report), key=lambda error: list(error.absolute_path))
    return None if not errors else f"{'/'.join(map(str, errors[0].absolute_path))}: {errors[0].message[:300]}"


def main():
    schema = json.load(open(os.path.join(ROOT, "docs/report.schema.json")))
    jsonschema.Draft202012Validator.check_schema(schema)
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(os.path.join(ROOT, "models"), os.path.join(folder, "models"))
        open(os.path.join(folder, "wires.obj"), "w").write("v 0 0 0\nv 1 0 0\nl 1 2\np 1\n")
        here = {**os.environ, "XDG_CACHE_HOME": os.path.join(folder, "cache")}
        for name, words in REPORTS:
            done = subprocess.run([SCANOUT, *words], cwd=folder, capture_output=True, text=True, env=here)
            if done.returncode != 0:
                wrong.append(f"{' '.join(words)}: exit code {done.returncode}: {done.stderr}")
                continue
            report = json.loads(done.stdout)
            fault = check(schema, name, report)
            if fault:
                wrong.append(f"{' '.join(words)}: {fault}")
            if isinstance(report, dict) and check(schema, name, {**report, "another": 1}) is None:
                wrong.append(f"{name}: a member that the schema does not know is let through")
    unused = set(schema["$defs"]) - {name for name, _ in REPORTS} - {"interval", "price", "change", "hazard_pixels"}
    if unused:
        wrong.append(f"no output is held against {sorted(unused)}")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(REPORTS)} outputs are as the schema says")


if __name__ == "__main__":
    main()
