"""Instructions and functions of a program's calls of one function, by valgrind's callgrind: exact where a clock is not."""
import glob
import os
import re
import shutil
import subprocess
import tempfile

NAME = re.compile(r"^fn=\((\d+)\)(?: (.*))?$")


def is_there():
    return shutil.which("valgrind") is not None


def parse(path, names):
    """(instructions, {symbols that ran}) of one dump. `names`: callgrind writes a name once, then its number."""
    instructions, ran = None, set()
    with open(path, errors="replace") as file:
        for line in file:
            for number, name in re.findall(r"^c?fn=\((\d+)\) (.*)$", line):
                names[number] = name
            match = NAME.match(line)
            if match:
                ran.add(names[match[1]].split("'")[0])  # 'N: recursion
            elif line.startswith(("summary:", "totals:")):
                instructions = int(line.split()[1])
    return instructions, ran


def calls(collected, dumped, command):
    """Runs the command on AVX2, which callgrind knows. Collects inside of the function `collected`; dumps after each call
    of `dumped` inside or outside of it (callgrind cannot do both for one function). Returns the command's output and, for
    each dump, parse()'s pair. The checks that test builds put after each stage do not count inside of `collected`."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        done = subprocess.run(["valgrind", "--tool=callgrind", "--demangle=no", f"--callgrind-out-file={out}",
                               f"--toggle-collect={collected}*", "--toggle-collect=*check_lanes*",
                               f"--dump-after={dumped}*", *command, "--target", "avx2"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{command}: exit code {done.returncode}\n{done.stderr}")
        dumps = sorted(glob.glob(out + ".*"), key=lambda p: int(p.rsplit(".", 1)[1]))
        names = {}
        return done.stdout, [parse(path, names) for path in dumps]
