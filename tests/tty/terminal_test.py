#!/usr/bin/env python3
"""terminal_test.py SCANOUT ROOT [TEST...]: the viewer on a terminal (`--backend terminal`), which emulator.py plays: the pictures
that arrive, keys and mouse, one frame at a time, and a terminal that is as before however the program ends."""
import array
import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest

from emulator import LIMIT
from terminal_case import LEFT, RIGHT, ROOT, SCANOUT, STILL, TerminalTest
from terminal_ends import Ends  # noqa: F401: unittest finds it here


def linear(code):
    c = code / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


LINEAR = [linear(code) for code in range(256)]


def encoded(level):
    level = 12.92 * level if level <= 0.0031308 else 1.055 * level ** (1 / 2.4) - 0.055
    return round(level * 255)


class Pictures(TerminalTest):
    def test_kittys_picture_is_the_headless_frame_to_the_bit(self):
        terminal = self.shown(kitty=True)
        self.assert_same(terminal.pictures[-1], self.headless(640, 384))
        self.assertEqual(len(terminal.images), 1, "one picture stays in the terminal's memory")
        self.acts(terminal, LEFT, "rotate_left")
        self.assert_same(terminal.pictures[-1], self.headless(640, 384, "rotate_left"))
        self.assertEqual(len(terminal.images), 1)
        self.leave_by_q(terminal)

    def test_sixels_differ_by_what_256_colours_can_not_show(self):
        terminal = self.shown(sixel=True)
        width, height, pixels = terminal.pictures[-1]
        expected = self.headless(640, 366)
        self.assertEqual((width, height), expected[:2], "whole bands of six rows, and the last row of cells free")
        differences = [a - b for a, b in zip(pixels, expected[2])]
        self.assertLess((sum(d * d for d in differences) / len(differences)) ** 0.5, 2.5)
        self.assertLess(max(map(abs, differences)), 32)
        background = expected[2][:3]
        self.assertLessEqual(max(abs(a - b) for a, b in zip(pixels[:3], background)), 2, "percents are coarser than codes")
        self.leave_by_q(terminal)

    def test_sixels_keep_to_the_colours_that_the_terminal_has(self):
        terminal = self.shown(sixel=True, registers=16)
        pixels = terminal.pictures[-1][2]
        self.assertLessEqual(len({pixels[i:i + 3] for i in range(0, len(pixels), 3)}), 16)

    def half_blocks(self, terminal, columns=80, rows=24):
        """Of the cells: the average of the frame's pixels in linear light."""
        across, down = 7, 14
        width, height, pixels = self.headless(columns * across, rows * down)
        lines = [array.array("d", (LINEAR[code] for code in pixels[3 * width * y:3 * width * (y + 1)])) for y in range(height)]
        expected = {}
        for row in range(rows):
            for column in range(columns):
                halves = []
                for top in (row * down, row * down + across):
                    halves.append(tuple(encoded(sum(lines[y][3 * x + c] for y in range(top, top + across)
                                                    for x in range(column * across, (column + 1) * across)) / across ** 2) for c in range(3)))
                expected[row, column] = tuple(halves)
        return expected

    def test_half_blocks_are_the_averages_of_their_pixels(self):
        terminal = self.shown()
        shown, expected = terminal.half_blocks(), self.half_blocks(terminal)
        self.assertEqual(shown.keys(), expected.keys())
        worst = max(abs(a - b) for place in shown for half, wanted in zip(shown[place], expected[place]) for a, b in zip(half, wanted))
        self.assertLessEqual(worst, 1, "a code of rounding")
        self.leave_by_q(terminal)

    def test_without_24_bits_the_nearest_of_256_colours_is_shown(self):
        terminal = self.shown(true_colour=False)
        shown, expected = terminal.half_blocks(), self.half_blocks(terminal)
        self.assertNotIn(b";2;", re.sub(rb"\x1b\[48;2;1;2;3m", b"", terminal.raw))
        levels = (0, 95, 135, 175, 215, 255)
        palette = [(r, g, b) for r in levels for g in levels for b in levels] + [(8 + 10 * i,) * 3 for i in range(24)]
        distance = lambda a, b: sum((x - y) ** 2 for x, y in zip(a, b))
        for place in list(shown)[::97]:
            for half, wanted in zip(shown[place], expected[place]):
                nearest = min(distance(colour, wanted) for colour in palette)
                self.assertLessEqual(distance(half, wanted) ** 0.5, nearest ** 0.5 + 4, "the average was rounded, too")
        terminal.type("\x1b")
        self.leave(terminal)

    def test_with_half_blocks_help_is_text(self):
        terminal = self.shown()
        before = terminal.half_blocks()
        self.acts(terminal, "h", "toggle_help")
        self.assertIn("rotate", terminal.text())
        self.assertIn("page 1 of", terminal.text())
        self.acts(terminal, "\x1b", "close")
        self.assert_same(terminal.half_blocks(), before)
        self.leave_by_q(terminal)

    def test_only_cells_that_change_are_written(self):
        terminal = self.shown()
        first = len(terminal.raw)
        self.acts(terminal, "i", "toggle_info")
        self.assertLess(len(terminal.raw) - first, first / 3)

    def test_a_window_of_another_size_gets_a_picture_of_it(self):
        terminal = self.shown(kitty=True, line_pixels=True)
        terminal.set_size(60, 30)
        terminal.wait_for(lambda: terminal.pictures[-1][:2] == (480, 480), "a picture of the new size")
        terminal.settle()
        self.assert_same(terminal.pictures[-1], self.headless(480, 480))
        self.leave_by_q(terminal)

    def test_half_blocks_follow_the_windows_size(self):
        terminal = self.shown()
        terminal.set_size(40, 12)
        terminal.wait_for(lambda: len(terminal.cells) == 480, "as many cells")
        terminal.settle()
        expected = self.half_blocks(terminal, 40, 12)
        self.assertEqual(terminal.half_blocks().keys(), expected.keys())
        self.assertLessEqual(max(abs(a - b) for place, halves in terminal.half_blocks().items()
                                 for half, wanted in zip(halves, expected[place]) for a, b in zip(half, wanted)), 1)


class Questions(TerminalTest):
    def test_a_mute_terminal_gets_half_blocks(self):
        terminal = self.shown(answers=False, kitty=True)
        self.assertTrue(terminal.half_blocks())
        self.assertIn(b"the terminal does not answer", terminal.said)
        self.leave_by_q(terminal)

    def test_answers_that_come_late_are_taken_all_the_same(self):
        terminal = self.shown(answers=False, kitty=True)
        self.assertEqual(terminal.pictures, [])
        terminal.answers = True
        terminal.type(b"\x1b_Gi=31;OK\x1b\\\x1b[6;16;8t\x1b[?62;4c")
        terminal.wait_for(lambda: terminal.pictures, "kitty's graphics")
        terminal.settle()
        self.assert_same(terminal.pictures[-1], self.headless(640, 384))
        self.leave_by_q(terminal)

    def test_the_cells_size_may_come_from_the_line(self):
        terminal = self.shown(kitty=True, line_pixels=True, cell=(10, 20))
        self.assertEqual(terminal.pictures[-1][:2], (800, 480))

    def test_graphics_without_a_cells_size_are_half_blocks_and_it_is_said_why(self):
        terminal = self.shown(sixel=True, cell=None)
        self.assertTrue(terminal.half_blocks())
        self.assertIn(b"does not say how large its cells are", terminal.said)

    def test_what_is_asked_for_is_taken(self):
        for asked in ("kitty", "sixel", "blocks"):
            with self.subTest(asked):
                terminal = self.shown([*STILL, "--terminal", asked], kitty=True, sixel=True)
                self.assertEqual(bool(terminal.sixel_bytes), asked == "sixel")
                self.assertEqual(bool(terminal.images), asked == "kitty")
                self.assertEqual(bool(terminal.half_blocks()), asked == "blocks")
                self.leave_by_q(terminal)

    def test_what_cannot_be_shown_is_refused_in_one_line(self):
        terminal = self.start([*STILL, "--terminal", "sixel"], sixel=True, cell=None)
        self.leave(terminal, 5)
        self.assertRegex(terminal.said, rb"\Ascanout: --terminal sixel: [^\n]*\n\Z")

    def test_what_is_no_terminal_gets_nothing(self):
        for stdin in (subprocess.DEVNULL, None):
            done = subprocess.run([*STILL], stdin=stdin, capture_output=True, start_new_session=True)
            self.assertEqual(done.returncode, 5)
            self.assertEqual(done.stdout, b"")
            self.assertRegex(done.stderr, rb"\Ascanout: --backend terminal: [^\n]*\n\Z")

    def test_another_terminal_than_its_own_is_refused_in_one_line(self):
        master, slave = os.openpty()
        self.addCleanup(lambda: (os.close(master), os.close(slave)))
        terminal = self.start(["/bin/sh", "-c", f'exec "$@" >{os.ttyname(slave)}', "sh", *STILL])
        self.leave(terminal, 5)
        self.assertRegex(terminal.said, rb"\Ascanout: --backend terminal: standard output is another terminal [^\n]*\n\Z")
        self.assertEqual(terminal.raw, b"")

    def test_a_picture_that_is_refused_is_followed_by_what_is_left(self):
        for what in ({"sixel": True}, {}):
            for asked in ("auto", "kitty"):
                with self.subTest(asked=asked, **what):
                    terminal = self.shown([*STILL, "--terminal", asked], kitty=True, refuses=b"ENOMEM:no", **what)
                    self.assertEqual(bool(terminal.sixel_bytes), "sixel" in what)
                    self.assertEqual(bool(terminal.half_blocks()), "sixel" not in what)
                    self.assertEqual(terminal.said.count(b"could not take kitty's picture: ENOMEM:no\n"), 1)
                    self.assertEqual(terminal.images, {}, "it would cover what follows")
                    self.leave_by_q(terminal)

    def test_a_terminal_that_only_prints_gets_nothing(self):
        terminal = self.start(environment={"TERM": "dumb"})
        self.leave(terminal, 5)
        self.assertRegex(terminal.said, rb"\Ascanout: [^\n]*TERM=dumb[^\n]*\n\Z")
        self.assertEqual(terminal.raw, b"")

    def test_keys_typed_while_it_is_asked_are_kept(self):
        terminal = self.start(kitty=True, answers=False)
        terminal.wait_for(lambda: b"\x1b[c" in terminal.raw, "the questions")
        terminal.type(LEFT)
        terminal.wait_for_line(" rotate_left")

    def test_half_an_answer_and_escape_are_given_up(self):
        for typed, key, what in ((b"\x1b_Gi=31;O", "i", lambda t: b" toggle_info" in t.said), (b"\x1b", "", lambda t: b"ended" in t.reported)):
            with self.subTest(typed=typed):
                terminal = self.start(answers=False)
                terminal.wait_for(lambda: b"\x1b[c" in terminal.raw, "the questions")
                terminal.type(typed)
                end = time.monotonic() + LIMIT
                while not what(terminal) and time.monotonic() < end:
                    if key:
                        terminal.type(key)
                    terminal.read(0.02)
                self.assertTrue(what(terminal))


class Frames(TerminalTest):
    def test_one_frame_is_on_its_way_at_a_time(self):
        for what in ({"kitty": True}, {"sixel": True}, {}):
            with self.subTest(**what):
                terminal = self.start(holds=True, **what)
                terminal.wait_for(lambda: terminal.frames == 1, "the first frame")
                for times in range(1, 4):
                    terminal.type(LEFT)
                    terminal.wait_for_line(" rotate_left", times)
                self.assertEqual(terminal.frames, 1, "the first one is not answered")
                self.assertNotIn(b"frame 0 ", terminal.said)
                terminal.answer_frame()
                terminal.wait_for(lambda: terminal.frames == 2, "the second frame")
                self.assertIn(b"frame 0 ", terminal.said)
                terminal.answer_frame()
                terminal.settle()
                self.assertEqual(terminal.frames, 2, "three keys, and one frame that shows them all")
                if terminal.kitty:
                    self.assert_same(terminal.pictures[-1], self.headless(640, 384, *["rotate_left"] * 3))
                self.leave_by_q(terminal)

    def test_a_terminal_that_does_not_answer_a_frame_can_be_left(self):
        terminal = self.start(holds=True, kitty=True)
        terminal.wait_for(lambda: terminal.frames == 1, "the first frame")
        self.leave_by_q(terminal)

    def test_idle_it_writes_nothing_and_does_not_wake_up(self):
        for what in ({"kitty": True}, {}):
            terminal = self.shown(**what)
            before = self.switches(terminal)
            self.assertFalse(terminal.read(2), "there is output")
            self.assertLessEqual(self.switches(terminal) - before, 1, "more often than to begin with")

    def test_the_time_from_a_key_to_its_frame_is_reported(self):
        report = os.path.join(self.folder, "report.json")
        terminal = self.shown([*STILL, f"--json={report}"], kitty=True)
        for key, action in ((LEFT, "rotate_left"), (RIGHT, "rotate_right"), ("\x1b[6~", "next_file"), (LEFT, "rotate_left")):
            self.acts(terminal, key, action)
        self.leave_by_q(terminal)
        with open(report) as file:
            times = json.load(file)["input_to_screen_ms"]
        self.assertEqual(times["count"], 3, "one key changes nothing")
        self.assertGreater(times["median"], 0)
        self.assertLessEqual(times["median"], times["p99"])

    @staticmethod
    def switches(terminal):
        """How often the main thread went to sleep."""
        with open(f"/proc/{terminal.pid}/task/{terminal.pid}/status") as status:
            return int(re.search(r"\nvoluntary_ctxt_switches:\s*(\d+)", status.read())[1])


class KeysAndMouse(TerminalTest):
    def test_keys_are_those_of_the_console(self):
        terminal = self.shown(kitty=True)
        for typed, action in ((LEFT, "rotate_left"), ("\x1b[1;2C", "move_right"), ("\x1bOA", "rotate_up"), ("+", "scale_up"), ("e", "edges_next"),
                              ("5", "toggle_projection")):
            self.acts(terminal, typed, action)
        self.leave_by_q(terminal)

    def test_the_mouse_drags_by_cells_and_by_pixels_where_those_are_told(self):
        for pixel_mouse, scale in ((False, (1, 1)), (True, (8, 16))):
            with self.subTest(pixel_mouse=pixel_mouse):
                terminal = self.shown(kitty=True, pixel_mouse=pixel_mouse)
                self.assertEqual(terminal.modes.get(1016, False), pixel_mouse)
                self.assertTrue(terminal.modes[1003] and terminal.modes[1006])
                x, y = scale
                report = lambda code, column, row, end="M": f"\x1b[<{code};{1 + column * x};{1 + row * y}{end}"
                actions = self.acts(terminal, report(0, 40, 12) + report(32, 48, 13) + report(0, 48, 13, "m"), "drag_begin", "drag_rotate 64 16",
                                    "drag_end")
                self.assertEqual([a for a in actions if not a.startswith("pointer")], ["drag_begin", "drag_rotate 64 16", "drag_end"])
                self.assert_same(terminal.pictures[-1], self.headless(640, 384, "drag_begin", "drag_rotate 64 16", "drag_end"))
                wheel = self.acts(terminal, report(64, 40, 12), r"zoom_at .*")
                self.assertRegex(" ".join(wheel), r"zoom_at 8 " + ("320 192" if pixel_mouse else "324 200"))
                self.acts(terminal, report(4, 40, 12) + report(36, 41, 12) + report(4, 41, 12, "m"), r"drag_move 8 0")
                self.leave_by_q(terminal)

    def test_the_windows_pointer_is_the_only_one(self):
        terminal = self.shown(kitty=True)
        frames = terminal.frames
        terminal.type("\x1b[<35;20;10M")
        terminal.wait_for_line(" pointer")
        self.acts(terminal, "i", "toggle_info")
        self.assertEqual(terminal.frames, frames + 1, "its motion draws nothing")

    def test_pasted_text_is_no_keys(self):
        terminal = self.shown(kitty=True)
        before = len(terminal.said)
        terminal.type("\x1b[200~qqe" + LEFT + "\x1b[201~" + RIGHT)
        terminal.wait_for_line(" rotate_right")
        self.assertNotIn(b"edges_next", terminal.said[before:])

    def test_a_sequence_may_come_in_parts(self):
        terminal = self.shown(kitty=True)
        terminal.type("\x1b[1;2")
        terminal.type("C")
        terminal.wait_for_line(" move_right")


class Pages(TerminalTest):
    def test_their_commands_draw(self):
        commands = []
        for page in ("README.md", "docs/TERMINAL.md"):
            with open(os.path.join(ROOT, page)) as text:
                commands += re.findall(r"^\./run (.*--backend terminal[^#\n]*)", text.read(), re.M)
        self.assertGreater(len(commands), 2)
        os.symlink(os.path.join(ROOT, "models"), os.path.join(self.folder, "models"))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for command in commands:
            with self.subTest(command):
                terminal = self.start([SCANOUT, *command.split(), "--no-config"], kitty=True)
                terminal.wait_for(lambda: terminal.images or terminal.cells, "a picture")
                self.assertEqual(bool(terminal.half_blocks()), "blocks" in command)
                self.leave_by_q(terminal)


class Tmux(TerminalTest):
    def test_kittys_picture_goes_through_tmux_onto_placeholders(self):
        terminal = self.shown(kitty=True, tmux="open")
        self.assert_same(terminal.pictures[-1], self.headless(640, 384))
        image, columns, rows = terminal.placed[-1]
        self.assertEqual((columns, rows), (80, 24))
        self.assertEqual(len(terminal.cells), 80 * 24)
        self.assertEqual({cell[0][0] for cell in terminal.cells.values()}, {"\U0010EEEE"})
        self.assertEqual({cell[1] for cell in terminal.cells.values()}, {(image >> 16, image >> 8 & 255, image & 255)})
        marks = [terminal.cells[row, 0][0][1:] for row in range(24)]
        self.assertEqual(marks[:3], ["\u0305\u0305", "\u030d\u0305", "\u030e\u0305"])
        self.assertNotIn(b"\x1b_G", re.sub(rb"\x1bPtmux;(?:[^\x1b]|\x1b\x1b)*\x1b\\", b"", terminal.raw), "all of it is wrapped")
        self.leave_by_q(terminal)

    def test_where_nothing_gets_through_it_is_said_why(self):
        terminal = self.shown(kitty=True, tmux="closed")
        self.assertTrue(terminal.half_blocks())
        self.assertEqual(len(re.findall(rb"half blocks: no picture gets through tmux[^\n]*\n", terminal.said)), 1)
        self.leave_by_q(terminal)

    def test_sixels_for_tmux_stay_under_a_megabyte(self):
        noise = os.path.join(self.folder, "noise.obj")
        with open(noise, "w") as file:  # many small triangles of many colours
            for i in range(20000):
                x, y = i % 200, i // 200
                for dx, dy in ((0, 0), (1, 0), (0, 1)):
                    file.write(f"v {x + dx} {y + dy} 0 {i * 37 % 101 / 100} {i * 53 % 103 / 102} {i * 71 % 107 / 106}\n")
                file.write("f -3 -2 -1\n")
        terminal = self.shown([SCANOUT, "view", noise, *STILL[3:], "--view", "front"], sixel=True, tmux="closed", size=(240, 64))
        self.assertLess(terminal.sixel_bytes[-1], 1_000_000)
        plain = self.shown([SCANOUT, "view", noise, *STILL[3:], "--view", "front"], sixel=True, size=(240, 64))
        self.assertGreater(plain.sixel_bytes[-1], 1_000_000, "which this picture would not by itself")

    @unittest.skipUnless(shutil.which("tmux"), "tmux is not installed")
    def test_tmux_itself_shows_half_blocks_and_its_pane_is_as_before(self):
        socket = f"scanout-test-{os.getpid()}"
        tmux = lambda *words: subprocess.run(["tmux", "-L", socket, "-f", "/dev/null", *words], check=True, capture_output=True, text=True).stdout
        self.addCleanup(lambda: subprocess.run(["tmux", "-L", socket, "kill-server"], capture_output=True))
        log = os.path.join(self.folder, "log")
        os.mkfifo(log)
        command = " ".join(STILL) + f" 2>{log}; echo code $? >{log}2; cat"
        tmux("new-session", "-d", "-x", "80", "-y", "24", command)
        with open(log) as lines:
            for line in lines:
                if line == "settled\n":
                    break
            self.assertGreater(tmux("capture-pane", "-p").count("▀"), 100)
            self.assertEqual(tmux("display-message", "-p", "#{alternate_on} #{cursor_flag} #{mouse_all_flag}"), "1 0 1\n")
            tmux("send-keys", "q")
            lines.read()
        self.assertEqual(tmux("display-message", "-p", "#{alternate_on} #{cursor_flag} #{mouse_all_flag}"), "0 1 0\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
