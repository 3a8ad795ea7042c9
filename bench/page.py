"""bench/README.md: the scripts here remake its tables, each between two marks of its own."""
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
README = ROOT / "bench/README.md"
MADE = (":(exclude)bench/README.md", ":(exclude,glob)bench/growth/*.svg") # by the scripts: they change no figure


def git(*command):
    return subprocess.run(["git", *command], cwd=ROOT, capture_output=True, text=True)


def commit():
    dirty = git("diff", "--quiet", "HEAD", "--", ".", *MADE).returncode != 0
    return (git("rev-parse", "--short", "HEAD").stdout.strip() or "unknown") + ("-dirty" if dirty else "")


def machine():
    name = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), os.uname().machine)
    return f"{name}, {len(os.sched_getaffinity(0))} cores, commit {commit()}"


def remake(name, text):
    """Puts text between the marks <!-- name --> and <!-- end of name -->."""
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
    before, rest = README.read_text().split(begin, 1)
    README.write_text(before + begin + text + "\n" + end + rest.split(end, 1)[1])
