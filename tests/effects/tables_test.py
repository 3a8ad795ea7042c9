#!/usr/bin/env python3
"""tables.py on tables that are sound, changed or broken."""
import unittest

import tables

PLAIN = """plain.obj  12 triangles  64x48  36.5 % of pixels covered
nothing special is called for
effect   runs       memory  codes    FLIP  pixels  because
texture  off             0      0  0.0000       0  no triangle has a texture
shading  per_pixel       0     12  0.0100     300  12 triangles are lit
dither   none            0                         8 bits hide their steps
switching on any of the 1 that are off: 0 pixels differ
"""
SPOT = """spot.obj  5856 triangles  64x48  19.2 % of pixels covered
effect   runs         memory  codes    FLIP  pixels  because
texture  trilinear  4096 KiB    238  0.1208    5306  5856 of 5856 triangles have a texture, 19.2 %
shading  per_pixel         0     58  0.0106    4732  5856 triangles are lit
dither   none              0      0  0.0000       0  8 bits hide their steps
"""
KNOT = SPOT.replace("spot", "knot").replace("5856", "7000").replace("238", "100")
MODELS = {"plain": "made/plain.obj", "spot": "models/spot.obj", "knot": "models/knot.obj"}


def files(plain=PLAIN, spot=SPOT, knot=KNOT, models=MODELS):
    return tables.files({"plain": plain, "spot": spot, "knot": knot}, models)


def changed(**texts):
    before, after = files(), files(**texts)
    return [name for name in before if before[name] != after[name]]


class Tables(unittest.TestCase):
    def test_plain_is_kept_to_the_letter_and_of_others_what_differs(self):
        written = files()
        self.assertEqual(written["plain"], PLAIN)
        cells = [line.split(None, 1) for line in written["knot"].splitlines()[1:]]
        self.assertEqual([name for name, _ in cells], ["(picture)", "(special)", "texture", "shading", "dither", "(proof)"])
        self.assertEqual(cells[2][1].split("  as ")[-1], "spot: 7000, 7000, 19.2")
        self.assertEqual(cells[3][1].split("  as ")[-1], "plain: 7000")
        self.assertEqual(cells[4][1].split(), ["0", "0.0000", "0"])
        self.assertIn("5856 of 5856 triangles have a texture, 19.2 %", written["spot"])

    def test_a_changed_word_changes_one_file(self):
        def everywhere(old, new):
            self.assertIn(old, PLAIN + SPOT)
            return changed(plain=PLAIN.replace(old, new), spot=SPOT.replace(old, new), knot=KNOT.replace(old, new))
        self.assertEqual(everywhere("hide their", "hide all"), ["plain"])
        self.assertEqual(everywhere("are lit", "have light"), ["plain"])
        self.assertEqual(everywhere("pixels covered", "it covered"), ["plain"])
        self.assertEqual(everywhere("have a texture", "wear a texture"), ["spot"])

    def test_each_changed_cell_changes_the_scenes_file(self):
        for old, new in (("5856 triangles  64", "5855 triangles  64"), ("trilinear  4096", "bilinear   4096"), ("4096", "4095"),
                         (" 238", " 239"), ("0.1208", "0.1209"), ("5306", "5307"), ("5856 of 5856", "5855 of 5856"),
                         ("of 5856 tri", "of 5857 tri"), ("5856 triangles are", "5857 triangles are"), ("0      0  0.0000", "0      1  0.0000"),
                         ("a texture, ", "a texture; "), ("4732  ", "4732   "), ("0      0  0.0000       0  8", "0                         8")):
            self.assertIn(old, SPOT)
            self.assertIn("spot", changed(spot=SPOT.replace(old, new)), old)

    def test_a_row_too_many_or_too_few_changes_the_scenes_file(self):
        rows = SPOT.splitlines(True)
        self.assertEqual(changed(knot=KNOT + "switching on what is off changes pixels in 1 of 2 rows\n"), ["knot"])
        self.assertEqual(changed(knot=KNOT + "toning   none              0      0  0.0000       0  new\n"), ["knot"])
        self.assertEqual(changed(spot="".join(rows[:-1])), ["spot"])

    def test_a_table_that_is_laid_out_otherwise_is_malformed(self):
        for broken in (SPOT.replace("  codes", " codes"), SPOT.replace("58  0.0106", "58 0.0106"), SPOT.replace("none    ", "none   "),
                       SPOT.replace("spot.obj", "other.obj"), SPOT[:-1], "", SPOT + "more\nand more\n",
                       SPOT + SPOT.splitlines(True)[-1], SPOT.replace("because", "because ")):
            with self.assertRaises(tables.Malformed, msg=broken):
                files(spot=broken)

    def test_what_may_be_absent_is_nobodys_example(self):
        written = files(models={**MODELS, "spot": "assets/spot.obj"})
        self.assertIn("5856 of 5856 triangles have a texture", written["spot"])
        self.assertIn("7000 of 7000 triangles have a texture", written["knot"])


if __name__ == "__main__":
    unittest.main()
