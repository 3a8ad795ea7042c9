#!/usr/bin/env python3
"""gltf.py SCANOUT FOLDER [--table FILE]: every glTF and GLB file that FOLDER/MANIFEST.tsv lists, held against its row: a model opens
with as many triangles as the row counts over all nodes and with the row's bounding box, or is refused where the row says that nothing
can be drawn; a bad file ends with exit code 0, or 3 and one line that names it. --table: the file that gets a line a file. Exit 77
(skipped) where FOLDER is not there.
"""
import argparse
import csv
import json
import os
import re
import subprocess
import sys

# What the row leaves open, or counts otherwise than the default scene at rest.
EITHER = re.compile(r"(?i)or (a )?(clear )?message|clear message or|or a message")
# Opens elsewhere, by extensions that are required and unknown here; of the newest meshopt codec a part opens.
REQUIRED = {"models/asset_generator_Compatibility/Compatibility_05.gltf", "models/sharpgltf_tower/tower.glb"}
IN_PART = {"models/khr_MeshoptCubeTest/MeshoptCubeTest.gltf"}
REFUSED = re.compile(r"(?i)^(nothing to draw|clear message for version|refused)")
# Files whose boxes in the table are of an instance, of a skin, or of nothing.
WITHOUT_BOX = re.compile(r"skins [1-9]|EXT_mesh_gpu_instancing|KHR_draco|meshopt|KHR_mesh_quantization|i3dm|nstanc")

# Boxes by hand where the table's leave out the weights that meshes give to their morph targets.
MORPHED = {
    "models/gltf_simplemorph/SimpleMorph.gltf": "0 0 0 1 1.5 0",
    "models/khr_MorphPrimitivesTest/MorphPrimitivesTest.glb": "-0.5 0 -0.5 0.5 0.1 0.5",
}


def told(program, path):
    """Exit code, lines on standard error, and the report, of scanout info."""
    run = subprocess.run([program, "info", path, "--json=-"], capture_output=True, text=True, timeout=120, check=False)
    lines = run.stderr.strip().splitlines()
    return run.returncode, lines, json.loads(run.stdout) if run.returncode == 0 else None


def box_fault(row, report):
    numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", MORPHED.get(row["path"], row["bbox_min_max"]))]
    if len(numbers) != 6 or WITHOUT_BOX.search(row["features"]):
        return None
    found = report["box"]["min"] + report["box"]["max"]
    size = max(numbers[3 + a] - numbers[a] for a in range(3)) or 1
    # The table turns the boxes of nodes, not their vertices: where nodes are turned it says more.
    beyond = max(max(numbers[a] - found[a], found[3 + a] - numbers[3 + a]) for a in range(3)) / size
    met = sum(abs(a - b) <= 2e-3 * size for a, b in zip(numbers, found))
    return f"box {found} for {numbers}" if beyond > 2e-3 or met < 3 else None


def fault(row, code, lines, report):
    named = os.path.basename(row["path"])
    if code not in (0, 3):
        return f"exit code {code}: {' | '.join(lines)[:300]}"
    if code == 3 and (len(lines) != 1 or named not in lines[0]):
        return f"not one line that names the file: {lines}"
    if row["path"].startswith("bad/"):
        return None
    drawn = re.search(r"tris drawn (\d+)", row["features"])
    if REFUSED.search(row["expected"]):
        return None if code == 3 else "opens, and should be refused"
    if code == 3:
        empty = row["vertices"] == "0" or row["path"] in REQUIRED
        return None if empty or EITHER.search(row["expected"]) else f"refused: {lines[0]}"
    if drawn and "nstanc" not in row["features"] and row["path"] not in IN_PART and int(drawn[1]) != report["faces"]:
        return f"{report['faces']} triangles, {drawn[1]} are right"
    return box_fault(row, report)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--table")
    a = parser.parse_args()
    if not os.path.isdir(a.folder):
        print("the asset set is not here")
        return 77
    with open(os.path.join(a.folder, "MANIFEST.tsv"), encoding="utf-8", newline="") as file:
        rows = [r for r in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
                if r["format"] in ("gltf", "glb") and r["path"].startswith(("models/", "bad/"))]
    wrong, table, opened = 0, [], 0
    for row in rows:
        code, lines, report = told(os.path.abspath(a.program), os.path.join(a.folder, row["path"]))
        found = fault(row, code, lines, report)
        opened += code == 0
        wrong += found is not None
        if found:
            print(f"{row['path']}: {found}", file=sys.stderr, flush=True)
        said = (report["warnings"] if report else lines) or [""]
        table.append("\t".join([row["path"], str(code), found or "right", said[0].replace(a.folder.rstrip("/") + "/", "")]))
    if a.table:
        with open(a.table, "w", encoding="utf-8") as out:
            out.write("\n".join(table) + "\n")
    print(f"{len(rows)} glTF and GLB files, {opened} open, {wrong} differ from their rows")
    return 1 if wrong or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
