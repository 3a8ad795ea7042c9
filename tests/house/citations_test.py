#!/usr/bin/env python3
"""citations.py against a sound tree and broken ones: a check that sees no fault in a broken tree is worth nothing."""
import pathlib
import tempfile
import unittest

import citations

REFERENCES = """# References

- **Primer** "A primer", a textbook.

- **Blinn 1977** "Models of light reflection", SIGGRAPH 77.
- **Olano and Greer 1997** "Triangle scan conversion", Graphics Hardware.
"""
CASES = """# Hard cases

- **33** Affine interpolation bends. *Oracle:* exact weights (Olano and Greer 1997).
  *Passes:* 2^-20. *Tests:* `Interpolated.DoesNotBend`, `house.layers`, `effects.plain`.
- **P7** Guard bands. *Oracle:* each other. *Passes:* no sample. *Tests:* `Guard.Holds`,
  `cli.readme`.
- **P8** Tiles. *Oracle:* hashes. *Passes:* one. *Tests:* `Guard.Holds`.
"""
SOUND = {
    "docs/REFERENCES.md": REFERENCES,
    "docs/HARD-CASES.md": CASES,
    "README.md": "Highlights by Blinn 1977. See `docs/REFERENCES.md`, tests/vm/README.md.\n",
    "tests/vm/README.md": "",
    "src/shade/blinn.cpp": '// The half vector. Blinn 1977, [Primer 7, 9.4]; edges: Olano and Greer\n// 1997 (HARD-CASES\n// 33).\n'
                           'constinit const Stage blinn{{.blurb = "a highlight",\n    .source = "Blinn 1977"}};\n'
                           'int size = 2000; // [Surface]\nconstexpr Size kSize{1920, 1080};\n',
    "tests/guard_test.cpp": "// HARD-CASES P7-P8: both. [0, 1]\nTEST(Guard, Holds) {\n}\nRC_GTEST_PROP(Interpolated, DoesNotBend,\n"
                            "              (int a)) {}\n",
    "tests/CMakeLists.txt": "add_test(NAME house.layers\n  COMMAND x)\nscanout_cli_test(readme cli/readme.py)\n",
    "tests/effects/scenes.txt": "# scenes\nplain | made/plain.obj |\n",
}


class Citations(unittest.TestCase):
    def faults(self, **changes):
        """Those of the sound tree with changes: file=(old, new), or file=text."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name)
        for name, text in {**SOUND, **changes.get("files", {})}.items():
            if isinstance(text, tuple):
                self.assertIn(text[0], SOUND[name])
                text = SOUND[name].replace(*text)
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return citations.faults(root)

    def assert_one(self, words, files):
        found = self.faults(files=files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def comment(self, text, words):
        self.assert_one(words, {"tests/more.h": f"// {text}\n"})

    def test_a_sound_tree_has_no_faults(self):
        self.assertEqual(self.faults(), [])

    def test_a_paper_without_an_entry_is_seen(self):
        self.comment("Shadow volumes: Crow 1977.", "'Crow 1977' has no entry")
        self.comment("Walter et al. 2007", "has no entry")
        self.comment("by Greer 1997, alone", "'Greer 1997' has no entry")
        self.comment("Shadow volumes: Crow\n// 1977.", "'Crow 1977' has no entry")

    def test_a_paper_cited_in_another_form_is_seen(self):
        self.comment('J. Blinn, "Models of light reflection for pictures", 1977.', "write author and year")
        self.comment("As Blinn's, 1977, says", "write Blinn 1977")
        self.comment("Blinn (1977) says", "write Blinn 1977")

    def test_a_book_without_an_entry_is_seen(self):
        self.comment("Bilinear: [Handbook 3.3].", "[Handbook 3.3] has no entry")
        self.comment("Bilinear: [HandBook].", "[HandBook] has no entry")
        self.comment("Bilinear: [A 3.3].", "[A 3.3] has no entry")
        self.comment("Bilinear: [A ch.3], of A'.", "[A ch.3] has no entry")

    def test_a_hard_case_without_an_entry_is_seen(self):
        self.comment("HARD-CASES 33, 34: both", "HARD-CASES 34 has no entry")
        self.comment("HARD-CASES P6-P8", "HARD-CASES P6 has no entry")
        self.comment("HARD-CASES\n// R19", "HARD-CASES R19 has no entry")
        self.comment("HARD-CASES row 33", "names no entry")

    def test_a_page_that_is_not_there_is_seen(self):
        self.comment("By the model of PEERS.md.", "there is no PEERS.md")
        self.assert_one("there is no docs/GONE.md", {"README.md": ("docs/REFERENCES.md", "docs/GONE.md")})
        self.comment("TOPICS T7", "not in the repository")

    def test_what_nothing_cites_is_seen(self):
        self.assert_one("nothing cites P8", {"tests/guard_test.cpp": ("P7-P8", "P7")})
        self.assert_one("nothing cites Primer", {"src/shade/blinn.cpp": ("[Primer 7, 9.4]", "and so on")})
        self.assert_one("nothing cites Crow 1977", {"docs/REFERENCES.md": REFERENCES + "- **Crow 1977** Shadows.\n"})

    def test_an_entry_does_not_cite_itself_nor_its_neighbours(self):
        self.assert_one("nothing cites P8", {"tests/guard_test.cpp": ("P7-P8", "P7"),
                                             "docs/REFERENCES.md": ("SIGGRAPH 77", "HARD-CASES P8")})

    def test_a_test_that_does_not_exist_is_seen(self):
        self.assert_one("33: there is no test Interpolated.DoesNotBend", {"tests/guard_test.cpp": ("DoesNotBend", "Bends")})
        self.assert_one("there is no test house.layers", {"tests/CMakeLists.txt": ("house.layers", "house.rows")})
        self.assert_one("there is no test effects.plain", {"tests/effects/scenes.txt": ("plain |", "plainer |")})
        self.assert_one("there is no test cli.readme", {"tests/CMakeLists.txt": ("(readme", "(pages")})

    def test_an_entry_without_oracle_criterion_or_tests_is_seen(self):
        self.assert_one("33 has no 'Oracle:'", {"docs/HARD-CASES.md": ("*Oracle:* exact", "Exact")})
        self.assert_one("33 has no 'Passes:'", {"docs/HARD-CASES.md": ("*Passes:* 2^-20", "2^-20")})
        self.assert_one("P8 is held by no test", {"docs/HARD-CASES.md": ("*Passes:* one. *Tests:* `Guard.Holds`.", "*Passes:* one. *Tests:* none.")})

    def test_what_users_see_names_papers_alone(self):
        code = SOUND["src/shade/blinn.cpp"]
        self.assert_one("name papers alone", {"src/shade/blinn.cpp": code.replace('"Blinn 1977"', '"Blinn 1977, [Primer 7]"')})
        self.assert_one("name papers alone", {"src/shade/blinn.cpp": code.replace('"a highlight"', '"a highlight,\\n"\n    "HARD-CASES 33"')})
        self.assert_one("name papers alone", {"platform/help.cpp": 'const char* help = "see [Primer 2]"; // yes\n'})
        self.assert_one("name papers alone", {"README.md": ("Blinn 1977", "Blinn 1977 (HARD-CASES 33)")})

    def test_a_card_without_a_paper_is_seen(self):
        self.assert_one("'photography' names no paper", {"src/shade/blinn.cpp": ('"Blinn 1977"', '"photography"')})
        self.assert_one("'' names no paper", {"src/shade/blinn.cpp": ('"Blinn 1977"', '""')})

    def test_an_empty_tree_is_no_sound_one(self):
        self.assertIn("no entries", "\n".join(self.faults(files={"docs/REFERENCES.md": "", "docs/HARD-CASES.md": ""})))


if __name__ == "__main__":
    unittest.main()
