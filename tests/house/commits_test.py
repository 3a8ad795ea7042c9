#!/usr/bin/env python3
"""commits.py against sound and bad subjects, and in histories of a temporary repository."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import commits

SCRIPT = pathlib.Path(__file__).with_name("commits.py")


def git(folder, *words):
    names = ["-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false", "-c", "init.defaultBranch=main"]
    done = subprocess.run(["git", *names, "-C", folder, *words], check=True, capture_output=True, text=True)
    return done.stdout.strip()


class Subjects(unittest.TestCase):
    def test_sound_subjects_pass(self):
        for subject in ("raster: call specks micro-triangles", "tests, bench: cite hard cases in one form", "README: process one page",
                        "raster/micro: pass ids", "view: need no second timer", "shade: bring lanes together", "io: alias tables",
                        "a: " + "b" * 57):
            self.assertIsNone(commits.fault(subject), subject)

    def test_bad_subjects_are_seen(self):
        for subject, words in (("raster: strips stand by how many rows they have", "'strips' is no imperative"),
                               ("raster: added a kernel", "'added' is no imperative"), ("raster: adding a kernel", "'adding'"),
                               ("raster: the tile keeps ids", "begins with 'the'"), ("raster: Add a kernel", "lower case"),
                               ("draft a page", "the form is"), ("wip", "the form is"), ("raster:add a kernel", "the form is"),
                               ("raster: 2 kernels less", "no verb"), ("raster: add a kernel.", "full stop"),
                               ("a: " + "b" * 58, "61 characters")):
            self.assertIn(words, commits.fault(subject) or "", subject)


class Histories(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        git(self.root, "init", "-q")
        self.commit("whatever was said before")
        self.since = git(self.root, "rev-parse", "HEAD")

    def commit(self, subject):
        git(self.root, "commit", "-q", "--allow-empty", "-m", subject)

    def run_script(self, root=None):
        done = subprocess.run([sys.executable, "-B", SCRIPT, root or self.root, self.since], capture_output=True, text=True)
        return done.returncode, done.stdout

    def test_only_what_comes_after_counts(self):
        self.commit("raster: add a kernel")
        self.assertEqual(self.run_script(), (0, f"1 subjects after {self.since}\n"))

    def test_one_bad_subject_among_sound_ones_fails(self):
        for subject in ("raster: add a kernel", "raster: adds a kernel", "shade: drop a kernel"):
            self.commit(subject)
        status, said = self.run_script()
        self.assertEqual((status, said.count("\n")), (1, 1))
        self.assertIn("raster: adds a kernel: 'adds' is no imperative", said)

    def test_a_shallow_history_and_none_are_skipped(self):
        self.commit("raster: adds a kernel")
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.run_script(folder)[0], 77)
            git(folder, "clone", "-q", "--depth=1", f"file://{self.root}", "shallow")
            self.assertEqual(self.run_script(f"{folder}/shallow")[0], 77)


if __name__ == "__main__":
    if commits.git(".", "--version") is None:
        sys.exit(commits.SKIPPED)
    unittest.main()
