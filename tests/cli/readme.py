#!/usr/bin/env python3
"""readme.py SCANOUT ROOT [--write]: runs every command of README.md and docs/*.md, as written, in an empty folder that holds the models.

`./run ARGUMENTS` becomes SCANOUT ARGUMENTS. `./run` and `./test` alone are what CI does; the stage `cli` runs the first.
A viewer command plays a recording that quits at once, because a test machine's screen is not ours to take.
--write writes the table of techniques and the pictures that README.md shows anew, as the program has them.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

SCANOUT, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
QUIT = "scanout-actions 1\n0 rotate_left\n+1 quit\n"


def commands(text):
    """The command lines of the page: those of its sh blocks, and the run steps of the CI job."""
    found = []
    for block in re.findall(r"```sh\n(.*?)```", text, re.S):
        found += [re.sub(r"\s+#.*", "", line) for line in block.splitlines() if line.strip()]
    for block in re.findall(r"```yaml\n(.*?)```", text, re.S):
        found += re.findall(r"- run: (\./run .*)", block)
    return found


def as_run_here(command):
    if "parallel " in command:  # tests/cli/many_machines.py runs these
        return None
    before, run, rest = command.partition("./run ")
    words = ["./run", *rest.split()]
    if words[1:] == ["restore"]:  # it is for a console: tests/vm runs it
        return None
    if "--backend terminal" in rest:  # tests/tty/terminal_test.py runs these
        return None
    if not run or (before and not before.startswith("SCANOUT_OPTIONS=")):
        return None
    if words[1] not in ("render", "explain", "frontier", "doctor", "info", "compare", "spectrum", "colour", "synthesise", "list", "generate", "help",
                        "version") and "--backend" not in words:
        rest += " --backend headless --replay quit.actions"
    return f"{before}'{SCANOUT}' {rest}"


def fail(*lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)


def tables():
    """The rows of the technique table: what the program has, in its order."""
    listed = {}
    for line in subprocess.run([SCANOUT, "list", "techniques"], check=True, capture_output=True, text=True).stdout.splitlines():
        axis, name = line.split()[:2]
        listed.setdefault(axis, []).append(name)
    return "".join(f"| {axis} | " + " ".join(f"`{n}`" for n in names) + " |\n" for axis, names in listed.items())


TECHNIQUES = "docs/TECHNIQUES.md"
TABLE = re.compile(r"(\| axis \| techniques; those that differ in accuracy stand cheapest first \|\n\|---\|---\|\n)((?:\|.*\n)+)")


checked = set()  # pictures


def check_tables(page):
    found = TABLE.search(page)
    if found is None or found[2] != tables():
        fail(TECHNIQUES + ": the table of techniques is not what the program has: readme.py SCANOUT ROOT --write writes it")


def write_tables():
    path = os.path.join(ROOT, TECHNIQUES)
    page = open(path).read()
    written, count = TABLE.subn(lambda found: found[1] + tables(), page)
    if count != 1:
        fail(TECHNIQUES + ": there is no table of techniques to write")
    open(path, "w").write(written)


def run(command, here, folder):
    """Runs a command of a page; every picture that it names must be there afterwards."""
    here_alone = {**os.environ, "XDG_CACHE_HOME": os.path.join(folder, "caches")}
    done = subprocess.run(["bash", "-c", here], cwd=folder, capture_output=True, timeout=60, env=here_alone)
    if done.returncode != 0:
        fail(f"{command}: exit code {done.returncode}", done.stderr.decode())
    for output in re.findall(r"-o '?([\w.{}-]+)'?", command):
        if output != "-" and not os.path.exists(os.path.join(folder, output.replace("{n}", "0").replace("{frame}", "0").replace("{name}", "spot"))):
            fail(f"{command}: wrote no {output}")


def pictures_shown():
    page = open(os.path.join(ROOT, "README.md")).read()
    return set(os.path.basename(path) for path in re.findall(r"!\[[^]]*\]\((docs/pictures/\S+)\)", page))


def check_picture(name, folder):
    """A picture that README.md shows is what its command draws."""
    shown = {"spot.png": "models/spot/spot-by-scanout.png"}.get(name, f"docs/pictures/{name}")
    drawn, shown = os.path.join(folder, name), os.path.join(ROOT, shown)
    if name in checked or (name not in pictures_shown() and name != "spot.png"):
        return
    checked.add(name)
    if sys.argv[3:] == ["--write"]:
        shutil.copy(drawn, shown)
        return
    done = subprocess.run([SCANOUT, "compare", drawn, shown], capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{name} is not what its command draws now: readme.py SCANOUT ROOT --write writes it", done.stdout + done.stderr)


def run_all(path, folder):
    """How many commands of the page ran."""
    ran = 0
    for command in commands(open(path).read()):
        here = as_run_here(command)
        if here is None:
            continue
        run(command, here, folder)
        drawn = re.findall(r"-o (\w+\.png)", command)
        for script in re.findall(r"--replay (docs/\S+)", command):
            drawn += re.findall(r"^\S+ frame (\S+\.png)$", open(os.path.join(folder, script)).read(), re.M)
        for name in drawn:
            check_picture(name, folder)
        ran += 1
    print(f"{ran} commands of {os.path.relpath(path, ROOT)} ran")
    return ran


def main():
    readme = os.path.join(ROOT, "README.md")
    if sys.argv[3:] == ["--write"]:
        write_tables()
    check_tables(open(os.path.join(ROOT, TECHNIQUES)).read())
    with tempfile.TemporaryDirectory() as folder:
        for name in ("models", "tests", "docs"):
            shutil.copytree(os.path.join(ROOT, name), os.path.join(folder, name))
        open(os.path.join(folder, "quit.actions"), "w").write(QUIT)
        ran = run_all(readme, folder)
        others = sum(run_all(path, folder) for path in sorted(glob.glob(os.path.join(ROOT, "docs/*.md"))))
    if ran < 9 or others < 50:
        fail("README.md or docs: too few commands found; has the form of their blocks changed?")
    shown = pictures_shown()
    if len(shown) < 5 or shown - checked:
        fail(f"README.md: no command draws {sorted(shown - checked)}")


if __name__ == "__main__":
    main()
