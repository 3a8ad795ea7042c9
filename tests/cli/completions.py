#!/usr/bin/env python3
"""completions.py SCANOUT: completes command lines in a bash that has read `scanout generate bash`; where zsh and fish are
installed, has them read theirs, and fish complete the same lines; formats the manual page without a warning of groff."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

SCANOUT = os.path.abspath(sys.argv[1])

# words before the cursor, the word at it, some of what is offered, some of what is not
LINES = [
    ([], "ren", ["render"], ["view", "list"]),
    ([], "mod", ["model one.obj"], ["render"]),
    (["render"], "--sam", ["--samples"], ["--camera", "--backend"]),
    (["render", "x.obj"], "--back", ["--background"], ["--backend"]),
    (["x.obj"], "--back", ["--background", "--backend"], ["--hash"]),
    (["render", "--cull"], "", ["none", "back", "front"], ["model one.obj"]),
    (["render", "--shadow"], "map", ["map_pcf", "map_soft"], ["volume"]),
    (["view", "--size"], "", [], ["model one.obj", "none"]),
    (["render", "--output"], "mo", ["model one.obj"], ["--samples"]),
    (["compare"], "--", ["--max-diff", "--help-all"], ["--samples"]),
    (["list"], "", ["techniques", "keys"], ["model one.obj"]),
    (["generate"], "", ["man", "bash"], ["keys"]),
]


def generated(what):
    done = subprocess.run([SCANOUT, "generate", what],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def offered_by_bash(script, before, word):
    words = ["scanout", *before, word]
    text = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scanout; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "-euc", text, "bash", script, *words], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, (words, done.stderr)
    return done.stdout.splitlines()


def offered_by_fish(script, before, word):
    line = " ".join(["scanout", *before, word])
    done = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C '{line}'"],
                          capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, (line, done.stderr)
    return [text.split("\t")[0].replace("\\ ", " ") for text in done.stdout.splitlines()]


def main():
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        scripts = {}
        for what in ("man", "bash", "zsh", "fish"):
            scripts[what] = os.path.join(folder, what)
            with open(scripts[what], "w") as file:
                file.write(generated(what))
        work = os.path.join(folder, "work")
        os.mkdir(work)
        open(os.path.join(work, "model one.obj"), "w").close()
        os.chdir(work)
        shells = [("bash", offered_by_bash)] + ([("fish", offered_by_fish)] if shutil.which("fish") else [])
        for shell, offered in shells:
            for before, word, some, none in LINES:
                got = offered(scripts[shell], before, word)
                missing = [text for text in some if text not in got]
                wrong = [text for text in none if text in got]
                if missing or wrong:
                    failed.append(f"{shell}: {before} {word!r}: lacks {missing}, should not offer {wrong}")
        if shutil.which("zsh"):
            done = subprocess.run(["zsh", "-f", "-n", scripts["zsh"]], capture_output=True, text=True)
            if done.returncode or done.stderr:
                failed.append("zsh: " + done.stderr)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-Tascii", "-ww", scripts["man"]], capture_output=True, text=True)
            if done.returncode or done.stderr:
                failed.append("groff: " + done.stderr[:500])
            text = re.sub("\x1b\\[[0-9;]*m|.\b", "", done.stdout)
            if "--samples" not in text or "EXIT STATUS" not in text:
                failed.append("the manual page lacks --samples or EXIT STATUS")
    print("\n".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
