#!/usr/bin/env python3
"""pages.py against a sound tree and broken ones: a check that sees no fault in a broken tree is worth nothing."""
import pathlib
import tempfile
import unittest

import pages

GLOSSARY = "# Glossary\n\n- **" + "**\n- **".join(pages.TERMS) + "** `raster/tile/tile.h`\n"
SOUND = {
    "docs/GLOSSARY.md": GLOSSARY,
    "docs/RASTERISER.md": "A tile (`raster/tile/tile.h`, `raster/tile/{tile,area}`, `src/raster/*/tile.h`) is drawn by `VisibilityTile::draw()`; "
                          "see [terms](GLOSSARY.md#terms), `--depth`, `scanout list techniques`, `build/release/scanout`.\n\n"
                          "```sh\nrm `src/gone.h`\n```\n\n   ```cpp src/raster/tile/tile.h\n   class VisibilityTile {\n   ...\n"
                          "       int samples_ = 1;\n   };\n   ```\n",
    "CONTRIBUTING.md": "| stage | asks |\n|---|---|\n| `unit`, `golden` | What? |\n\n| `other` | x |\n",
    "scripts/stages.sh": "stage_unit() {\n}\nstage_golden() {\n}\nrun_unit() {\n}\n",
    "src/raster/tile/tile.h": "class VisibilityTile {\n    void draw();\n    int samples_ = 1;\n};\n",
    "src/raster/tile/area.cpp": "// Hi-Z, kept for each\n// tile bin\n",
}


class Pages(unittest.TestCase):
    def faults(self, files):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for name, text in {**SOUND, **files}.items():
            if isinstance(text, tuple):
                self.assertIn(text[0], SOUND[name])
                text = SOUND[name].replace(*text)
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return pages.faults(root)

    def assert_one(self, words, old, new, page="docs/RASTERISER.md"):
        found = self.faults({page: (old, new)})
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_sound_tree_has_no_faults(self):
        self.assertEqual(self.faults({}), [])

    def test_a_path_that_is_not_there_is_seen(self):
        self.assert_one("RASTERISER.md:1: there is no raster/tile/bin.h", "(`raster/tile/tile.h", "(`raster/tile/bin.h")
        self.assert_one("there is no raster/tile/row", "{tile,area}", "{tile,row}")
        self.assert_one("there is no src/raster/*/bin.h", "*/tile.h", "*/bin.h")
        self.assert_one("there is no terms.md", "(GLOSSARY.md#terms)", "(terms.md)")

    def test_a_name_that_no_source_says_is_seen(self):
        self.assert_one("no source says show", "draw()", "show()")
        self.assert_one("no source says ShownTile", "`VisibilityTile::draw()`", "`ShownTile`")

    def test_code_that_is_not_in_its_file_is_seen(self):
        self.assert_one("has no line 'class ShownTile {'", "class VisibilityTile {", "class ShownTile {")
        self.assert_one("has no line 'int samples_ = 1;'", "   ...\n", "")
        self.assert_one("there is no src/gone.h", "```cpp src/raster/tile/tile.h", "```cpp src/gone.h")

    def test_a_term_without_an_entry_or_a_hit_is_seen(self):
        self.assert_one("'Morton' has neither", "- **Morton**\n", "", "docs/GLOSSARY.md")
        self.assertEqual(self.faults({"docs/GLOSSARY.md": ("- **Hi-Z**\n", "")}), [])
        self.assertEqual(self.faults({"docs/GLOSSARY.md": ("- **tile bin**\n", "")}), [])

    def test_an_entry_may_hold_several_terms(self):
        both = GLOSSARY.replace("- **manifold**\n", "").replace("**watertight**", "**manifold, watertight**")
        self.assertEqual(self.faults({"docs/GLOSSARY.md": both}), [])

    def test_a_stage_that_is_not_told_and_one_that_is_not_there_are_seen(self):
        self.assert_one("CONTRIBUTING.md: says nothing of stage 'golden'", ", `golden`", "", "CONTRIBUTING.md")
        self.assert_one("CONTRIBUTING.md: there is no stage 'golden'", "stage_golden() {\n}\n", "", "scripts/stages.sh")

    def test_a_bare_name_of_a_file_is_looked_for_everywhere(self):
        self.assertEqual(self.faults({"docs/RASTERISER.md": ("(`raster/tile/tile.h`,", "(`area.cpp`,")}), [])
        self.assert_one("there is no bin.cpp", "(`raster/tile/tile.h`,", "(`bin.cpp`,")

    def test_pages_that_name_nothing_are_no_sound_ones(self):
        found = self.faults({"docs/RASTERISER.md": "Nothing.\n", "docs/GLOSSARY.md": GLOSSARY.replace(" `raster/tile/tile.h`", "")})
        self.assertIn("the pages name nothing", "\n".join(found))


if __name__ == "__main__":
    unittest.main()
