"""However the program ends, or is stopped, the terminal is as before."""
import os
import re
import signal
import time

from emulator import LIMIT
from terminal_case import LEFT, SCANOUT, SIGSTKFLT, STILL, TerminalTest, VIEW


def is_sanitized():
    """A sanitizer takes faults itself, and ends in its own way."""
    with open(SCANOUT, "rb") as program:
        return re.search(rb"__[at]san_init", program.read()) is not None


class Ends(TerminalTest):
    def test_the_terminal_is_as_before_after_every_key_and_signal(self):
        ways = [("q", 0), ("\x1b", 0), ("\x03", 0), ("\x1c", 0), (signal.SIGTERM, 0), (signal.SIGHUP, 0), (signal.SIGINT, 0),
                *((number, -number) for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGUSR1, signal.SIGUSR2, SIGSTKFLT, signal.SIGRTMIN,
                                              signal.SIGRTMAX))]
        for number, (way, code) in enumerate(ways):
            if is_sanitized() and code:
                continue
            what = ({"kitty": True}, {"sixel": True}, {}, {"answers": False})[number % 4]
            with self.subTest(way=way, **what):
                terminal = self.shown(**what)
                self.assertEqual({mode for mode, on in terminal.modes.items() if on}, {1049, 2004, 1003, 1006})
                self.assertNotEqual(terminal.line_modes(), terminal.first_modes)
                if isinstance(way, str):
                    terminal.type(way)
                else:
                    os.kill(terminal.pid, way)
                self.leave(terminal, code)

    def test_in_the_middle_of_a_frame(self):
        for way in (signal.SIGTERM, signal.SIGSEGV):
            with self.subTest(way=way):
                terminal = self.start(kitty=True, size=(240, 80))
                terminal.wait_for(lambda: terminal.loading, "the beginning of a picture")
                self.assertEqual(terminal.frames, 0, "its end waits for the terminal, which has not read on")
                os.kill(terminal.pid, way)
                terminal.end()
                self.assertIsNone(terminal.is_as_before())

    def test_what_is_said_is_written_when_the_text_is_back(self):
        terminal = self.start([word for word in VIEW if word != "--verbose"], sixel=True, cell=None, stderr_is_terminal=True)
        terminal.wait_for(lambda: terminal.frames > 0, "a frame")
        self.assertNotIn("half blocks", terminal.text())
        self.leave_by_q(terminal)
        self.assertIn(b"scanout: drawn as half blocks: the terminal does not say how large its cells are", terminal.on_main_screen)

    def test_suspended_the_shell_has_its_terminal_and_gets_it_anew(self):
        for what in ({"kitty": True}, {}):
            with self.subTest(**what):
                terminal = self.shown(as_job=True, **what)
                for stops in (1, 2):
                    terminal.type("\x1a")
                    terminal.wait_for(lambda: terminal.reported.count(b"stopped") == stops, "the stop")
                    while terminal.read(0):
                        pass
                    self.assertIsNone(terminal.is_as_before())
                    frames, said = terminal.frames, len(terminal.said)
                    os.write(terminal.orders, b"f")
                    terminal.wait_for(lambda: terminal.frames > frames and b"settled" in terminal.said[said:], "a frame")
                    self.assertTrue(terminal.modes[1049])
                    if terminal.kitty:
                        self.assert_same(terminal.pictures[-1], self.headless(640, 384))
                    else:
                        self.assertEqual(len(terminal.cells), 80 * 24, "all cells")
                self.leave_by_q(terminal)

    def test_continued_in_the_background_it_waits(self):
        terminal = self.shown(as_job=True)
        terminal.type("\x1a")
        terminal.wait_for(lambda: terminal.reported.count(b"stopped") == 1, "the stop")
        os.write(terminal.orders, b"b")
        terminal.wait_for(lambda: terminal.reported.count(b"stopped") == 2, "another stop")
        self.assertIsNone(terminal.is_as_before())
        os.write(terminal.orders, b"f")
        terminal.wait_for(lambda: terminal.modes.get(1049) and len(terminal.cells) == 80 * 24, "the picture")
        self.leave_by_q(terminal)

    def test_after_sigstop_and_sigcont_all_is_drawn_anew(self):
        terminal = self.shown(kitty=True, as_job=True)
        os.kill(terminal.pid, signal.SIGSTOP)
        terminal.wait_for(lambda: b"stopped" in terminal.reported, "the stop")
        frames = terminal.frames
        os.write(terminal.orders, b"f")
        terminal.wait_for(lambda: terminal.frames > frames, "a frame")
        self.leave_by_q(terminal)

    def test_stopped_and_told_to_end_it_ends_in_the_background(self):
        for stop, way, code in (("\x1a", signal.SIGTERM, 0), (signal.SIGSTOP, signal.SIGTERM, 0), (signal.SIGSTOP, signal.SIGSEGV, -signal.SIGSEGV)):
            if is_sanitized() and code:
                continue
            with self.subTest(stop=stop, way=way):
                terminal = self.shown(as_job=True)
                if isinstance(stop, str):
                    terminal.type(stop)
                else:
                    os.kill(terminal.pid, stop)
                terminal.wait_for(lambda: b"stopped" in terminal.reported, "the stop")
                os.kill(terminal.pid, way)
                os.write(terminal.orders, b"b")
                if code == 0:
                    self.assertEqual(terminal.end(), code)
                    self.assertEqual(terminal.reported.count(b"stopped"), 1)
                else:  # the thread that takes the signal may be a moment behind the one that waits for the foreground
                    terminal.wait_for(lambda: terminal.reported.count(b"stopped") == 2 or b"ended" in terminal.reported, "the end or a stop")
                    os.write(terminal.orders, b"b")
                    self.assertEqual(terminal.end(), code)
                self.assertEqual({mode for mode, on in terminal.modes.items() if on}, {7, 25})

    def test_suspended_and_told_to_end_it_does_not_take_the_terminal_again(self):
        terminal = self.shown(as_job=True)
        terminal.type("\x1a")
        terminal.wait_for(lambda: b"stopped" in terminal.reported, "the stop")
        while terminal.read(0):
            pass
        written = len(terminal.raw)
        os.kill(terminal.pid, signal.SIGTERM)
        os.write(terminal.orders, b"f")
        self.leave(terminal)
        self.assertEqual(terminal.raw[written:], b"")

    def test_no_answer_reaches_the_shell_however_late_it_comes(self):
        for what in ({"kitty": True}, {"sixel": True}, {}):
            for attempt in range(20):  # it waits for 2 s, which a busy machine may let pass
                terminal = self.shown(**what)
                frames, terminal.late = terminal.frames, []
                terminal.type(LEFT)
                terminal.wait_for(lambda: terminal.frames > frames, "a frame, which is not answered")
                terminal.type("q")
                terminal.wait_for(lambda: len(terminal.late) == 2, "the last question")
                asked = time.monotonic()
                os.write(terminal.master, terminal.late[0])
                terminal.wait_until_read()
                terminal.read(0.2)  # whoever takes this for the answer ends now
                os.write(terminal.master, terminal.late[1])
                if time.monotonic() - asked < 1.5:
                    break
            with self.subTest(**what):
                self.leave(terminal)
                self.assertEqual(terminal.left_to_read(), b"")

    def test_keys_do_not_put_off_the_end_in_a_terminal_that_has_become_mute(self):
        terminal = self.shown(sixel=True)
        terminal.answers = False
        terminal.type("q")
        end = time.monotonic() + LIMIT
        while b"ended" not in terminal.reported and time.monotonic() < end:
            terminal.type("x")
            terminal.read(0.02)
        self.assertIn(b"ended 0\n", terminal.reported)

    def test_without_standard_error_it_is_as_before_too(self):
        terminal = self.start(["/bin/sh", "-c", 'exec "$@" 2>&-', "sh", *STILL], kitty=True)
        terminal.wait_for(lambda: terminal.frames > 0, "a frame")
        self.leave_by_q(terminal)

    def test_where_nobody_could_continue_it_it_is_not_suspended(self):
        terminal = self.shown(kitty=True)  # as ssh runs a command
        frames = terminal.frames
        terminal.type("\x1a")
        terminal.wait_for(lambda: terminal.frames > frames, "the picture anew")
        terminal.type(LEFT)
        terminal.wait_for_line(" rotate_left")
        self.assertNotIn(b"stopped", terminal.reported)
        self.leave_by_q(terminal)
