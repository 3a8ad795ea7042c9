#!/usr/bin/env python3
"""faults.py on made-up trees: what is wrong with a patch must be seen, and a test that is missing, or that did not run,
must not count as failing."""
import pathlib
import tempfile
import unittest
import unittest.mock

import faults

PATCH = """A fault.
Must fail: raster.Cover.Once raster.All/Cover.Every/big
Must fail: raster.Cover.Twice

--- a/src/raster/a.cpp
+++ b/src/raster/a.cpp
@@ -1,3 +1,3 @@
 one
-two
+2
 three
"""
SOURCE = "one\ntwo\nthree\n"
TESTS = """TEST(Cover, Once) {
TEST_F(Cover, Twice) {
TEST_P(Cover, Every) {
INSTANTIATE_TEST_SUITE_P(All, Cover, testing::Values("big"));
"""


class Faults(unittest.TestCase):
    def tree(self, patch=PATCH, source=SOURCE, tests=TESTS):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for name, text in (("src/raster/a.cpp", source), ("tests/raster/a_test.cpp", tests), ("tests/faults/a.patch", patch)):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return root

    def assert_wrong(self, root, words):
        found = list(faults.check(root))
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_sound_patch_has_nothing_wrong_and_changes_nothing(self):
        root = self.tree()
        self.assertEqual(list(faults.check(root)), [])
        self.assertEqual((root / "src/raster/a.cpp").read_text(), SOURCE)

    def test_a_patch_that_no_longer_applies_is_seen_and_named(self):
        self.assert_wrong(self.tree(source="one\nzwei\nthree\n"), "tests/faults/a.patch: the patch no longer applies")

    def test_a_test_that_does_not_exist_is_seen(self):
        self.assert_wrong(self.tree(tests=TESTS.replace("Twice", "Thrice")), "there is no test raster.Cover.Twice")
        self.assert_wrong(self.tree(tests=TESTS.replace("(All", "(Some")), "there is no test raster.All/Cover.Every/big")

    def test_a_patch_without_tests_is_seen(self):
        with self.assertRaises(faults.Broken):
            list(faults.check(self.tree(patch=PATCH.replace("Must fail", "May fail"))))

    def test_applied_it_changes_the_copy_and_the_next_copy_undoes_it(self):
        root, copy = self.tree(), self.tree()
        faults.copy_tree(root, copy)
        before = (copy / "src/raster/a.cpp").stat().st_mtime_ns
        faults.copy_tree(root, copy)
        self.assertEqual((copy / "src/raster/a.cpp").stat().st_mtime_ns, before)
        faults.apply(faults.all_faults(root)[0], copy)
        self.assertEqual((copy / "src/raster/a.cpp").read_text(), "one\n2\nthree\n")
        faults.copy_tree(root, copy)
        self.assertEqual((copy / "src/raster/a.cpp").read_text(), SOURCE)

    def test_only_a_test_that_ran_and_failed_has_failed(self):
        for status, wrong in (("fail", None), ("run", "passed"), ("notrun", "did not run"), (None, "did not run")):
            got = {"raster.A.B": "fail"} | ({"raster.A.C": status} if status else {})
            with self.subTest(status), unittest.mock.patch.object(faults, "outcomes", return_value=got):
                if wrong is None:
                    faults.expect(None, ["raster.A.B", "raster.A.C"], "fail")
                    continue
                with self.assertRaisesRegex(faults.Broken, f"^raster.A.C: {wrong}"):
                    faults.expect(None, ["raster.A.B", "raster.A.C"], "fail")


if __name__ == "__main__":
    unittest.main()
