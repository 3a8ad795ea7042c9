#!/usr/bin/env python3
"""faults.py FOLDER [FAULT...]: do the tests see what they are there to see? Each tests/faults/FAULT.patch puts one
classical fault into a copy of the sources under FOLDER; every test that it names must then fail, all of which pass on
the sound copy.
faults.py --check: only whether each patch still applies and names tests that exist, which takes no build.

A patch begins with a line or two on the fault, then lines `Must fail: MODULE.SUITE.CASE ...`.
"""
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPIED = ("CMakeLists.txt", "CMakePresets.json", "cmake", "src", "platform", "tests", "bench", "models")
CORES = str(len(os.sched_getaffinity(0)))


@dataclasses.dataclass
class Fault:
    name: str
    patch: pathlib.Path
    files: list  # that the patch changes
    tests: list  # that must fail

    def programs(self):
        return sorted({"test_" + test.split(".")[0] for test in self.tests})


class Broken(Exception):
    """What is wrong with a patch, or with what it made of the sources."""


def read(patch):
    text = patch.read_text()
    files = re.findall(r"^\+\+\+ b/(\S+)", text, re.M)
    tests = re.findall(r"\S+", " ".join(re.findall(r"^Must fail:(.*)", text, re.M)))
    if not files or not tests:
        raise Broken(f"{patch}: changes no file, or names no test (`Must fail: MODULE.SUITE.CASE`)")
    return Fault(patch.stem, patch, files, tests)


def all_faults(root):
    """Those that change the same file stand together, so that one build undoes the last and makes the next; those that
    change how everything is built come last."""
    faults = [read(patch) for patch in (root / "tests/faults").glob("*.patch")]
    return sorted(faults, key=lambda f: (f.files[0].endswith(".cmake"), f.files, f.name))


def run(*command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def apply(fault, root, *options):
    done = run("patch", "-p1", "-f", "-s", "-r", "-", "--no-backup-if-mismatch", *options, "-d", root, "-i", fault.patch.resolve())
    if done.returncode != 0:
        raise Broken(f"the patch no longer applies; make it anew\n{done.stdout}")


def copy_tree(source, target):
    """Makes target like source. What is the same keeps its time, so that only what differs is built again."""
    wanted = set()
    for name in COPIED:
        for path in (source / name).rglob("*") if (source / name).is_dir() else [source / name]:
            if path.is_file() and path.suffix != ".pyc":
                wanted.add(path.relative_to(source))
    for path in [p for p in target.rglob("*") if p.is_file() and p.relative_to(target) not in wanted]:
        path.unlink()
    for name in wanted:
        copy, data = target / name, (source / name).read_bytes()
        if not copy.exists() or copy.read_bytes() != data:
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / name, copy)


def build(folder, programs):
    done = run("ninja", "-C", folder, *programs)
    if done.returncode != 0:
        raise Broken("does not build\n" + done.stdout[-3000:])


def outcomes(folder, tests):
    """{test: "run" (it passed), "fail", ...}; a test that CTest does not know is not in it."""
    names = "|".join(re.escape(test) for test in tests)
    report = folder / "faults.xml"
    report.unlink(missing_ok=True)
    # CTest adds a parameter that is not the name: `Suite.Case/name  # GetParam() = value`.
    done = run("ctest", "--test-dir", folder, "-j", CORES, "--output-junit", report, "-R", f"^({names})(  # .*)?$")
    if not report.exists():
        raise Broken(f"CTest ran nothing\n{done.stdout[-3000:]}")
    cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
    return {case.get("name").split("  # ")[0]: case.get("status") for case in cases}


def expect(folder, tests, wanted):
    got = outcomes(folder, tests)
    wrong = [f"{test}: {dict(run='passed', fail='failed').get(got.get(test), 'did not run; is there such a test?')}"
             for test in tests if got.get(test) != wanted]
    if wrong:
        raise Broken("\n".join(wrong))


def try_one(fault, tree, folder):
    sound = {name: (tree / name).read_bytes() for name in fault.files}
    try:
        apply(fault, tree)
        build(folder, fault.programs())
        expect(folder, fault.tests, "fail")
    finally:
        for name, data in sound.items():
            (tree / name).write_bytes(data)


def report(name, action, said):
    """Prints one line, or what is wrong; whether it went well."""
    start = time.monotonic()
    try:
        action()
        print(f"{name:<28} {time.monotonic() - start:5.0f} s  {said}", flush=True)
        return True
    except Broken as broken:
        print(f"{name:<28} {time.monotonic() - start:5.0f} s  FAILED: {broken}", flush=True)
        return False


def run_all(folder, wanted):
    faults = [f for f in all_faults(ROOT) if not wanted or f.name in wanted]
    if len(faults) == 0 or len(wanted) > len(faults):
        raise SystemExit(f"faults.py: not all of {wanted} are patches in tests/faults")
    tree, folder = folder.resolve() / "tree", folder.resolve() / "build"
    copy_tree(ROOT, tree)
    programs = sorted({program for fault in faults for program in fault.programs()})
    tests = sorted({test for fault in faults for test in fault.tests})

    def sound():
        if not (folder / "build.ninja").exists():
            made = run("cmake", "--preset", "release", "-S", tree, "-B", folder, "-DSCANOUT_TESTS=ON", "-DSCANOUT_FEW_TARGETS=ON",
                        "-DSCANOUT_PROGRAM=OFF", "-DSCANOUT_UNITY=OFF", cwd=tree)
            if made.returncode != 0:
                raise Broken(made.stdout[-3000:])
        build(folder, programs)
        expect(folder, tests, "run")

    if not report("(no fault)", sound, f"{len(tests)} tests pass"):
        print("0 passed, 1 failed")
        return False
    shown = [report(f.name, lambda f=f: try_one(f, tree, folder), f"{len(f.tests)} of {len(f.tests)} tests fail") for f in faults]
    print(f"{1 + sum(shown)} passed, {shown.count(False)} failed")
    return all(shown)


def exists(root, test):
    """Does a source define the test? Suite/case of TEST_P: a row of INSTANTIATE_TEST_SUITE_P, too."""
    module, name = test.split(".", 1)
    text = "\n".join(path.read_text() for path in sorted((root / "tests" / module).rglob("*_test.cpp")))
    parts = re.fullmatch(r"(?:(\w+)/)?(\w+)\.(\w+)(?:/\S+)?", name)
    if parts is None:
        return False
    row, suite, case = parts.groups()
    kind = r"TEST_P" if row else r"(?:TEST|TEST_F|RC_GTEST_PROP)"
    return bool(re.search(rf"^{kind}\(\s*{suite},\s*{case}\s*[,)]", text, re.M) and
                (row is None or re.search(rf"^INSTANTIATE_TEST_SUITE_P\(\s*{row},\s*{suite},", text, re.M)))


def check(root):
    """What is wrong with the patches, as lines."""
    for fault in all_faults(root):
        try:
            apply(fault, root, "--dry-run")
        except Broken as broken:
            yield f"tests/faults/{fault.name}.patch: {broken}"
        yield from (f"tests/faults/{fault.name}.patch: there is no test {test}" for test in fault.tests if not exists(root, test))


def main():
    if sys.argv[1:] == ["--check"]:
        wrong = list(check(ROOT))
        print(*wrong, sep="\n", end="\n" if wrong else "")
        sys.exit(bool(wrong))
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    sys.exit(not run_all(pathlib.Path(sys.argv[1]), sys.argv[2:]))


if __name__ == "__main__":
    main()
