#!/usr/bin/env python3
"""outcomes.py SCANOUT FOLDER [--seconds N] [--megabytes N] [--table FILE]: every file below FOLDER/models and FOLDER/bad
through render, doctor and explain, as a user would call them. A run ends with exit code 0, or 3 and one line on standard error
that names the file; no signal, no picture of a failed run. Limits of a run: a minute of CPU; of one of a bad file 2 seconds,
and a peak of 500 MB and twice the file's size; --seconds and --megabytes 0 say others, as for a build with sanitizers (0: none).
--table: the file that gets a line a file: path, exit codes, the first line printed. Exit 77 (skipped) where FOLDER is not there.
"""
import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time

COMMANDS = ("render", "doctor", "explain")
BESIDE = {".md", ".mtl", ".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".webp", ".ktx2", ".bin", ".txt", ".tsv", ".json", ".actions"}


class Run:
    """One call of the program."""

    def __init__(self, program, command, path, folder, size, seconds):
        out = os.path.join(folder, "out.png")
        options = {"render": ["-o", out, "--size", size, "--threads", "1"], "doctor": [], "explain": ["--no-times", "--size", "96x54"]}
        with tempfile.TemporaryFile() as error:
            start = time.monotonic()
            process = subprocess.Popen([program, command, path] + options[command], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=error,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)))
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = 0  # waited for here, not by subprocess
            self.elapsed = time.monotonic() - start
            error.seek(0)
            self.lines = error.read().decode(errors="replace").strip().splitlines()
        self.code = os.waitstatus_to_exitcode(status)
        self.cpu = usage.ru_utime + usage.ru_stime
        self.peak = usage.ru_maxrss * 1024
        self.picture = os.path.exists(out)
        if self.picture:
            os.unlink(out)
        self.left = os.listdir(folder)

    def faults(self, command, path):
        if self.code not in (0, 3):
            yield f"exit code {self.code}: {' | '.join(self.lines)[:2000]}"
        if self.code == 3 and (len(self.lines) != 1 or os.path.basename(path) not in self.lines[0]):
            yield f"not one line that names the file: {self.lines}"
        if command == "render" and self.picture != (self.code == 0):
            yield "exit code 0 without a picture" if self.code == 0 else "a picture is left behind"
        if self.left:
            yield f"left behind: {self.left}"


def files_below(root):
    for base, folders, names in os.walk(root):
        folders.sort()
        for name in sorted(names):
            if not name.endswith(".toml"):  # a motion, no model
                yield os.path.join(base, name)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--seconds", type=int, default=2)
    parser.add_argument("--megabytes", type=int, default=500)
    parser.add_argument("--table")
    a = parser.parse_args()
    if not os.path.isdir(a.folder):
        print("the asset set is not here")
        return 77
    program, rows, wrong, runs, most = os.path.abspath(a.program), [], 0, 0, (0, "")
    with tempfile.TemporaryDirectory() as folder:
        for part in ("models", "bad"):
            for path in files_below(os.path.join(a.folder, part)):
                if os.path.splitext(path)[1].lower() in BESIDE:
                    continue
                name, codes, said = os.path.relpath(path, a.folder), [], ""
                for command in COMMANDS:
                    run = Run(program, command, path, folder, "640x360" if part == "models" else "64x64", 60)
                    found = list(run.faults(command, path))
                    seconds, room = (a.seconds, (a.megabytes << 20) + 2 * os.path.getsize(path)) if part == "bad" else (60, 0)
                    if seconds and run.cpu > seconds:
                        found.append(f"{run.cpu:.1f} s of CPU")
                    if a.megabytes and room and run.peak > room:
                        found.append(f"a peak of {run.peak >> 20} MiB")
                    most = max(most, (round(run.cpu, 1), f"{command} {name}"))
                    for fault in found:
                        print(f"{command} {name}: {fault}", file=sys.stderr, flush=True)
                    wrong += bool(found)
                    runs += 1
                    codes.append(str(run.code))
                    said = said or (run.lines[0].replace(a.folder.rstrip("/") + "/", "") if run.lines else "")
                rows.append("\t".join([name, ",".join(codes), said]))
    if a.table:
        with open(a.table, "w", encoding="utf-8") as out:
            out.write("\n".join(rows) + "\n")
    print(f"{len(rows)} files, {runs} runs, {wrong} with a fault; the dearest: {most[0]} s of CPU, {most[1]}")
    return 1 if wrong or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
