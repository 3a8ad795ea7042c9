#!/usr/bin/env python3
"""coverage.py BUILD [--lines]: which lines and branches of src/io the runs of the programs in BUILD went through, by
the profiles under BUILD/profiles (LLVM_PROFILE_FILE). A table, a row a file; --lines adds the lines that nothing went
through. Exit code 1 below 95 % of the lines or 90 % of the branches.

A build with -DSCANOUT_FUZZ=ON -DSCANOUT_COVERAGE=ON and clang 14; `./test coverage` does all of it."""
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
LEAST = {"lines": 95.0, "branches": 90.0}  # %


def run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"coverage.py: {command[0]}: {done.stderr.strip()}")
    return done.stdout


def merged(build):
    profiles = sorted((build / "profiles").glob("*.profraw"))
    if not profiles:
        sys.exit(f"coverage.py: no profiles in {build}/profiles: run the tests and fuzz targets with LLVM_PROFILE_FILE")
    data = build / "profiles/all.profdata"
    run("llvm-profdata-14", "merge", "-sparse", "-o", data, *profiles)
    return data


def programs(build):
    found = sorted((build / "tests/fuzz").glob("fuzz_*")) + [build / "tests/test_io"]
    return [path for path in found if path.is_file() and path.suffix == ""]


def share(part):
    return 100.0 * part["covered"] / part["count"] if part["count"] else 100.0


def missed(file):
    """The lines that nothing went through. A segment holds from its place up to the next one."""
    lines, open_at = set(), None
    for line, _, count, has_count, *_ in file["segments"]:
        if open_at is not None:
            lines.update(range(open_at, line + 1))
        open_at = line if has_count and count == 0 else None
    return sorted(lines)


def ranges(lines):
    text, i = [], 0
    while i < len(lines):
        j = i
        while j + 1 < len(lines) and lines[j + 1] == lines[j] + 1:
            j += 1
        text.append(f"{lines[i]}" if i == j else f"{lines[i]}-{lines[j]}")
        i = j + 1
    return " ".join(text)


def main():
    build = pathlib.Path(sys.argv[1])
    binaries = programs(build)
    objects = [part for path in binaries[1:] for part in ("-object", path)]
    text = run("llvm-cov-14", "export", "-instr-profile", merged(build), binaries[0], *objects)
    files = [f for f in json.loads(text)["data"][0]["files"] if "/src/io/" in f["filename"]]
    total = {kind: {"count": 0, "covered": 0} for kind in LEAST}
    print(f"{'file':<28} {'lines':>12} {'%':>6} {'branches':>12} {'%':>6}")
    for file in sorted(files, key=lambda f: f["filename"]):
        row = file["filename"].rsplit("/src/io/")[-1].ljust(28)
        for kind in LEAST:
            part = file["summary"][kind]
            for key in total[kind]:
                total[kind][key] += part[key]
            row += f" {part['covered']:>5}/{part['count']:<6} {share(part):6.1f}"
        print(row)
        if "--lines" in sys.argv and missed(file):
            print("    not:", ranges(missed(file)))
    status = 0
    for kind, least in LEAST.items():
        reached = share(total[kind])
        low = reached < least
        print(f"src/io: {reached:.1f} % of {total[kind]['count']} {kind}{f', below {least:.0f} %' if low else ''}")
        status |= low
    return int(status)


if __name__ == "__main__":
    sys.exit(main())
