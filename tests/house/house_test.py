#!/usr/bin/env python3
"""layers.py and rows.py against sound and broken trees: a check that sees no fault in a broken tree is worth nothing."""
import pathlib
import tempfile
import unittest

import layers
import rows

MODULES = ["base:src/base:", "shade:src/shade:base", "drm:platform/drm:base", "console:platform:base", "app:src/app:base,shade,drm,console"]
SOUND = {
    "src/main.cpp": '#include "app/app.h"\n#include <vector>\n',
    "src/techniques.h": "#define SCANOUT_TEXTURE(X) \\\n    X(nearest) /* X(old) */ \\\n    X(bilinear)\n// X(none)\n",
    "src/base/fd.h": "#include <fcntl.h>\n",
    "src/shade/stage.h": '#include "base/fd.h"\n#include "techniques.h"\n',
    "src/shade/texture/nearest.cpp": '#include "shade/stage.h"\n',
    "src/shade/texture/bilinear.cpp": '#include "shade/stage.h"\n',
    "src/app/app.h": '#include "platform/drm/drm.h"\n#include "platform/seat.h"\n',
    "platform/seat.h": '#include "base/fd.h"\n',
    "platform/drm/drm.h": '#include "base/fd.h"\n',
}


class House(unittest.TestCase):
    def tree(self, **changes):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for name, text in {**SOUND, **changes.get("files", {})}.items():
            if text is not None:
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
        return root

    def layer_faults(self, files, modules=MODULES):
        return list(layers.faults(self.tree(files=files), modules))

    def row_faults(self, files):
        return list(rows.faults(self.tree(files=files)))

    def assert_one(self, found, words):
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_sound_tree_has_no_faults(self):
        self.assertEqual(self.layer_faults({}), [])
        self.assertEqual(self.row_faults({}), [])

    def test_an_upward_include_is_seen(self):
        self.assert_one(self.layer_faults({"src/base/fd.h": '\n#include "shade/stage.h"\n'}), "src/base/fd.h:2: base may not include shade")

    def test_an_upward_include_is_seen_however_it_is_spelt(self):
        for spelling in ('"../shade/stage.h"', '"src/shade/stage.h"', "<shade/stage.h>"):
            self.assert_one(self.layer_faults({"src/base/fd.h": f"  # include {spelling}\n"}), "base may not include shade")

    def test_only_app_names_the_platform(self):
        self.assert_one(self.layer_faults({"src/shade/stage.h": '#include "platform/drm/drm.h"\n'}), "shade may not include drm")

    def test_shared_console_code_does_not_name_a_display(self):
        self.assert_one(self.layer_faults({"platform/seat.h": '#include "platform/drm/drm.h"\n'}), "console may not include drm")

    def test_the_table_of_techniques_includes_no_module(self):
        self.assert_one(self.layer_faults({"src/techniques.h": '#include "base/fd.h"\n'}), "may not include base")

    def test_main_names_app_alone(self):
        self.assert_one(self.layer_faults({"src/main.cpp": '#include "base/fd.h"\n'}), "may not include base")

    def test_a_folder_without_a_module_is_seen(self):
        self.assert_one(self.layer_faults({"src/new/x.h": ""}), "stands in no module")

    def test_an_include_of_nothing_is_seen(self):
        self.assert_one(self.layer_faults({"src/base/fd.h": '#include "base/gone.h"\n'}), "there is no base/gone.h")

    def test_a_file_without_a_row_is_seen(self):
        self.assert_one(self.row_faults({"src/shade/texture/mip.cpp": ""}), "has no row X(mip) in SCANOUT_TEXTURE")

    def test_a_row_without_a_file_is_seen(self):
        self.assert_one(self.row_faults({"src/shade/texture/bilinear.cpp": None}), "texture/bilinear has no file")

    def test_a_file_in_the_wrong_axis_is_seen(self):
        table = SOUND["src/techniques.h"] + "#define SCANOUT_LIGHT(X)\n"
        moved = {"src/techniques.h": table, "src/shade/texture/bilinear.cpp": None, "src/shade/light/bilinear.cpp": ""}
        self.assertEqual(len(self.row_faults(moved)), 2)

    def test_a_folder_that_the_table_does_not_name_holds_what_it_likes(self):
        self.assertEqual(self.row_faults({"src/shade/gather/spans.cpp": "", "src/shade/gather/rows.cpp": ""}), [])

    def test_a_row_named_twice_is_seen(self):
        self.assert_one(self.row_faults({"src/techniques.h": "#define SCANOUT_TEXTURE(X) X(nearest) X(bilinear) X(nearest)\n"}), "more than one row")

    def test_a_helper_of_an_axis_has_a_header(self):
        helper = {"src/shade/texture/taps.cpp": "", "src/shade/texture/taps.h": ""}
        self.assertEqual(self.row_faults(helper), [])

    def test_rows_of_a_table_need_no_files(self):
        table = {"src/shade/texture/bilinear.cpp": None, "src/shade/texture/rows.cpp": "constinit const Filter bilinear{};\n"}
        self.assertEqual(self.row_faults(table), [])

    def test_a_row_that_stands_in_a_file_and_in_a_table_is_seen(self):
        table = {"src/shade/texture/rows.cpp": "constinit const Filter bilinear{};\n"}
        self.assert_one(self.row_faults(table), "texture/bilinear stands in")

    def test_a_row_of_a_table_without_a_name_is_seen(self):
        table = {"src/shade/texture/rows.cpp": "constinit const Filter mip{};\n"}
        self.assert_one(self.row_faults(table), "has no row X(mip) in SCANOUT_TEXTURE")

    def test_a_missing_table_is_seen(self):
        self.assert_one(self.row_faults({"src/techniques.h": None}), "names no axis")


if __name__ == "__main__":
    unittest.main()
