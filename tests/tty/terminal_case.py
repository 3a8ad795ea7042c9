"""The program on a terminal that emulator.py plays, and what each test of it begins and ends with. Takes SCANOUT and ROOT off the
command line."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

from emulator import Terminal, read_ppm

SCANOUT, ROOT = os.path.abspath(sys.argv.pop(1)), os.path.abspath(sys.argv.pop(1))
SPOT = os.path.join(ROOT, "models/spot/spot.obj")
STEADY = ["--converge", "off", "--budget", "none", "--threads", "2"]
VIEW = [SCANOUT, "view", SPOT, "--backend", "terminal", "--no-config", "--verbose", *STEADY]
STILL = [*VIEW, "--no-times"]  # no line about the keys
SIGSTKFLT = 16  # Python has no name for it
LEFT, RIGHT = "\x1b[D", "\x1b[C"


class TerminalTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def start(self, command=STILL, **what):
        terminal = Terminal(command, **what)
        self.addCleanup(terminal.close)
        return terminal

    def shown(self, command=STILL, **what):
        terminal = self.start(command, **what)
        terminal.settle()
        self.assertEqual(terminal.errors, [])
        return terminal

    def headless(self, width, height, *actions):
        """The same frame without a terminal: (width, height, RGB)."""
        with open(os.path.join(self.folder, "actions"), "w") as script:
            script.write("scanout-actions 1\n" + "".join(f"0 {action}\n" for action in (*actions, "frame frame.ppm", "quit")))
        subprocess.run([SCANOUT, "view", SPOT, "--no-config", "--backend", "headless", "--size", f"{width}x{height}", "--replay", "actions",
                        "--threads", "2", "--quiet"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return read_ppm(os.path.join(self.folder, "frame.ppm"))

    def acts(self, terminal, typed, *actions):
        before = len(terminal.said)
        terminal.type(typed)
        terminal.wait_for(lambda: terminal.said[before:].rstrip().endswith(b"settled") and all(
            re.search(rb"action \d+ " + action.encode() + rb"\n", terminal.said[before:]) for action in actions), f"{typed!r}: {actions}")
        return [line.split(b" ", 2)[2].decode() for line in terminal.said[before:].splitlines() if line.startswith(b"action ")]

    def assert_same(self, got, expected):
        self.assertTrue(got == expected, "pictures differ")  # assertEqual would take minutes to say where

    def leave_by_q(self, terminal):
        terminal.type("q")
        self.leave(terminal)

    def leave(self, terminal, code=0):
        self.assertEqual(terminal.end(), code)
        self.assertIsNone(terminal.is_as_before())
