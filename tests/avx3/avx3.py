#!/usr/bin/env python3
"""avx3.py BUILD FOLDER: the hashes and the lanes on AVX3, whatever CPU this is; FOLDER gets the logs. See README.md.

Exit code 0: every test passed on AVX3; 1: one did not; 77: it could not be tried, and a line says why.
"""
import pathlib
import re
import subprocess
import sys
import time

import guest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What Highway asks of a CPU for this target, by Linux's names.
FEATURES = {"avx512f", "avx512vl", "avx512dq", "avx512bw", "avx512cd", "avx2", "fma", "bmi1", "bmi2", "f16c"}
# Programs, and which of their cases: those on the target that is chosen by itself, without two that take minutes in the
# guest and whose techniques the hashes have too.
PROGRAMS = {"test_golden": "Hashes.AreThoseInTheRepository", "test_simd": "*",
            "test_shade": "-*.BlinnPhongIsTheFormula:*.BilinearIsTheOverlapOfATexelSizedSquare"}
DATA = [ROOT / "tests/golden/hashes.txt"]
TIMEOUT = 1800  # s; it takes 3 minutes of an idle core


def cpu_features():
    found = re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    return set(found.group(1).split()) if found else set()


def natively(programs, log):
    with open(log, "w") as out:
        for program in programs:
            run = subprocess.run([program, f"--gtest_filter={PROGRAMS[program.name]}"], stdout=out,
                                 stderr=subprocess.STDOUT, timeout=TIMEOUT)
            print(f"@exit {program.name} {run.returncode}", file=out, flush=True)


def verdict(said):
    """(what passed, what is wrong) by the output of PROGRAMS: each must pass, and the scenes be drawn on AVX3."""
    passed, wrong = [], []
    drawn = re.findall(r"^drawn on (\S+)$", said, re.M)
    if drawn != ["avx3"]:
        wrong.append(f"the scenes were drawn on {' and '.join(drawn) or 'nothing'}, not on avx3")
    parts = re.split(r"^@exit (\w+) (\d+)$", said, flags=re.M)
    ended = dict(zip(parts[1::3], zip(parts[0::3], parts[2::3])))
    for program in PROGRAMS:
        output, status = ended.get(program, ("", None))
        count = re.search(r"^\[  PASSED  \] (\d+) tests?\.$", output, re.M)
        if status == "0" and count and int(count.group(1)) > 0 and "[  SKIPPED ]" not in output:
            passed.append(f"{count.group(1)} of {program}")
        else:
            wrong.append(f"{program} " + ("did not end" if status is None else f"ended with {status}"))
    return passed, wrong


def self_test():
    good = "drawn on avx3\n" + "".join(f"[  PASSED  ] 1 test.\n@exit {program} 0\n" for program in PROGRAMS)
    assert verdict(good)[1] == []
    for right, spoilt in (("avx3", "avx2"), ("drawn on avx3\n", ""), ("1 test", "0 tests"), ("simd 0", "simd 1"),
                          ("@exit test_shade 0", ""), ("[  PASSED", "[  SKIPPED ] A.B\n[  PASSED")):
        assert verdict(good.replace(right, spoilt))[1], spoilt


def main():
    self_test()
    build, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    programs = [build / "tests" / name for name in PROGRAMS]
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "output.txt"
    log.write_text("")
    start = time.monotonic()
    here = FEATURES <= cpu_features()
    try:
        if here:
            natively(programs, log)
        else:
            guest.run({program: PROGRAMS[program.name] for program in programs}, DATA, folder, log, TIMEOUT)
    except guest.Unavailable as error:
        print(f"skipped: {error}")
        return 77
    said = log.read_text(errors="replace").replace("\r", "")
    passed, wrong = verdict(said)
    if wrong:
        print(f"{said[-4000:]}\n{'; '.join(wrong)}: see {folder}")
    print(f"on avx3, {'natively' if here else 'emulated'}: passed {', '.join(passed) or 'nothing'}; "
          f"{time.monotonic() - start:.0f} s")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
