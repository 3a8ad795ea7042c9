"""A terminal on a pseudo-terminal, for tests: it answers what the program asks as far as it is told to, follows the modes, and
turns kitty's graphics, sixels and coloured cells back into pictures. It waits for events alone: every wait ends with what was
waited for, or after LIMIT seconds with a failure."""
import base64
import fcntl
import os
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import zlib

LIMIT = float(os.environ.get("TERMINAL_TEST_LIMIT", 200))  # s, on a busy machine
HERE = os.path.dirname(os.path.abspath(__file__))

# A control sequence, a string up to its end, or characters.
TOKEN = re.compile(rb"\x1b\[([<=>?]?[0-9;:]*)([ !-/]*)([@-~])|\x1b([P_\]])(.*?)\x1b\\|\x18|\x1b\\|\x1b(?![\[P_\]])[ -/]*[0-~]|[^\x1b\x18]+", re.S)
TMUX = re.compile(rb"\x1bPtmux;((?:[^\x1b]|\x1b\x1b)*)\x1b\\", re.S)
SAVED = (25, 7)  # modes that are on at first


class Terminal:
    """kitty, sixel, true_colour: what it can. cell: pixels, or None where it does not say. answers: False, it is mute.
    holds: it answers no frame before answer_frame(). refuses: what it says to kitty's pictures. tmux: None, "closed" or "open" (allow-passthrough)."""

    def __init__(self, command, *, kitty=False, sixel=False, cell=(8, 16), size=(80, 24), true_colour=True, answers=True, holds=False,
                 refuses=None, tmux=None, pixel_mouse=False, line_pixels=False, registers=256, environment=(), as_job=False, stderr_is_terminal=False):
        self.kitty, self.sixel, self.cell, self.size, self.true_colour, self.answers, self.holds = kitty, sixel, cell, size, true_colour, answers, holds
        self.tmux, self.pixel_mouse, self.line_pixels, self.registers = tmux, pixel_mouse, line_pixels, registers
        self.refuses, self.late = refuses, None
        self.modes = {mode: True for mode in SAVED}
        self.rest, self.raw, self.held = b"", b"", []
        self.cursor, self.front, self.back = [0, 0], None, None
        self.cells, self.images, self.placed, self.loading = {}, {}, [], None
        self.frames, self.pictures, self.asked = 0, [], 0
        self.sixel_bytes, self.on_main_screen, self.said, self.errors = [], b"", b"", []
        master, slave = os.openpty()
        self.set_size(*size, fd=master)
        self.first_modes = termios.tcgetattr(slave)
        environment = {**{k: v for k, v in os.environ.items() if k not in ("COLORTERM", "TMUX", "SCANOUT_OPTIONS")}, "TERM": "xterm-256color",
                       **({"TMUX": "/tmp/none,1,0"} if tmux else {}), **dict(environment)}
        self.errors_read, errors_write = os.pipe()
        self.reports, reports_write = os.pipe()
        self.orders_read, self.orders = os.pipe()
        launcher = [sys.executable, "-B", os.path.join(HERE, "job.py"), str(reports_write), str(self.orders_read), "job" if as_job else "alone", *command]
        self.process = subprocess.Popen(launcher, stdin=slave, stdout=slave, stderr=slave if stderr_is_terminal else errors_write, env=environment,
                                        pass_fds=(reports_write, self.orders_read), start_new_session=True)
        for fd in (errors_write, reports_write):
            os.close(fd)
        self.slave, self.master = slave, master  # its own open slave: the pseudo-terminal outlives the program
        self.reported, self.pid = b"", None
        self.wait_for(lambda: b"\n" in self.reported, "the start")
        self.pid = int(self.reported.split()[0])

    def close(self):
        if self.process.poll() is None:
            for process in {self.pid, self.process.pid} - {None}:
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        self.process.wait()
        for fd in (self.master, self.slave, self.errors_read, self.reports, self.orders_read, self.orders):
            if fd >= 0:
                os.close(fd)

    def set_size(self, columns, rows, fd=None):
        self.size = (columns, rows)
        pixels = (columns * self.cell[0], rows * self.cell[1]) if self.line_pixels else (0, 0)
        fcntl.ioctl(self.master if fd is None else fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, *pixels))

    # ---- Events

    def wait_for(self, condition, what):
        end = time.monotonic() + LIMIT
        while not condition():
            left = end - time.monotonic()
            if left <= 0:
                raise AssertionError(f"in vain: {what}; said {self.said!r}, frames {self.frames}, last bytes {self.raw[-200:]!r}")
            self.read(left)

    def read(self, seconds):
        """Takes what comes next, if something comes within the time. False: nothing did."""
        sources = [fd for fd in (self.master, self.errors_read, self.reports) if fd >= 0]
        ready = select.select(sources, [], [], seconds)[0]
        for fd in ready:
            data = os.read(fd, 1 << 16)
            if fd == self.master:
                self.take(data)
            elif fd == self.errors_read:
                self.said += data
                if not data:
                    os.close(fd)
                    self.errors_read = -1
            else:
                self.reported += data
                if not data:
                    os.close(fd)
                    self.reports = -1
        return bool(ready)

    def type(self, text):
        os.write(self.master, text.encode() if isinstance(text, str) else text)

    def wait_for_line(self, text, times=1):
        self.wait_for(lambda: self.said.count(text.encode() + b"\n") >= times or self.said.count(text.encode()) >= times, text)

    def settle(self):
        """Until the screen shows all that was asked for."""
        self.wait_for(lambda: self.said.rstrip().endswith(b"settled"), "settled")

    def end(self):
        """Waits for the program's end; its exit code, negative for a signal."""
        self.wait_for(lambda: re.search(rb"ended (-?\d+)\n", self.reported), "the end")
        while self.read(0):
            pass
        return int(re.search(rb"ended (-?\d+)\n", self.reported)[1])

    def line_modes(self):
        return termios.tcgetattr(self.slave)

    # ---- What comes

    def reply(self, data):
        if self.late is not None:
            self.late.append(data)
        elif self.answers:
            os.write(self.master, data)

    def wait_until_read(self):
        """What was typed or answered is read."""
        end = time.monotonic() + LIMIT
        while struct.unpack("i", fcntl.ioctl(self.slave, termios.FIONREAD, b"    "))[0]:
            if time.monotonic() > end:
                raise AssertionError("in vain: nobody reads")
            time.sleep(0.001)

    def left_to_read(self):
        """What a shell would read now."""
        modes = termios.tcgetattr(self.slave)
        modes[3] &= ~termios.ICANON
        modes[6][termios.VMIN] = modes[6][termios.VTIME] = 0
        before = termios.tcgetattr(self.slave)
        termios.tcsetattr(self.slave, termios.TCSANOW, modes)
        try:
            return os.read(self.slave, 4096)
        finally:
            termios.tcsetattr(self.slave, termios.TCSANOW, before)

    def take(self, data):
        self.raw += data
        self.rest += data
        while self.rest:
            match = TMUX.match(self.rest) or TOKEN.match(self.rest)
            cut = self.rest.rfind(b"\x1b")
            # What has begun and may go on is kept: a sequence, a character of several bytes.
            if match is None or (match.end() == len(self.rest) and cut < 0 and self.rest[-1] >= 0x80 and not self.complete(match[0])):
                if b"\x18" in self.rest[1:]:
                    self.rest = self.rest[self.rest.index(b"\x18", 1):]
                    continue
                return
            if match[0][:2] in (b"\x1bP", b"\x1b_", b"\x1b]") and b"\x18" in match[0]:  # it was cut short
                self.rest = self.rest[self.rest.index(b"\x18"):]
                continue
            self.rest = self.rest[match.end():]
            self.token(match)

    @staticmethod
    def complete(text):
        try:
            text.decode()
            return True
        except UnicodeDecodeError as error:
            return error.end < len(text)

    def token(self, match):
        text = match[0]
        if text.startswith(b"\x1bPtmux;"):
            if self.tmux == "open":
                inner = match[1].replace(b"\x1b\x1b", b"\x1b")
                for part in TOKEN.finditer(inner):
                    self.token(part)
        elif match[3] is not None:
            self.sequence(match[1].decode(), match[2] + match[3])
        elif match[4] is not None:
            self.string(match[4], match[5])
        elif not text.startswith((b"\x1b", b"\x18")):
            self.characters(text.decode(errors="replace"))  # the rest may have been cut off

    def sequence(self, parameters, final):
        numbers = [int(n or 0) for n in re.split("[;:]", parameters.lstrip("?<=>"))]
        if final in (b"h", b"l") and parameters.startswith("?"):
            for mode in numbers:
                self.modes[mode] = final == b"h"
        elif final == b"m":
            self.colours(numbers)
        elif final == b"H":
            self.cursor = [max(numbers[0], 1) - 1, (max(numbers[1], 1) if len(numbers) > 1 else 1) - 1]
        elif final == b"J":
            self.cells = {}
        elif final == b"c":
            self.asked += 1
            answer = b"\x1b[?62;4c" if self.sixel else b"\x1b[?62c"
            if self.asked > 1 and self.modes.get(1049):
                self.frame(answer)
            else:
                self.reply(answer)
        elif final == b"n" and numbers[0] == 5:
            self.reply(b"\x1b[0n")
        elif final == b"t" and numbers[0] == 16 and self.cell:
            self.reply(b"\x1b[6;%d;%dt" % (self.cell[1], self.cell[0]))
        elif final == b"$p" and not self.tmux:
            known = numbers[0] == 2026 or numbers[0] == 1016 and self.pixel_mouse
            self.reply(b"\x1b[?%d;%d$y" % (numbers[0], 2 if known else 0))
        elif final == b"S" and parameters.startswith("?"):
            self.reply(b"\x1b[?1;0;%dS" % self.registers)

    def colours(self, numbers):
        while numbers:
            first = numbers.pop(0)
            if first == 0:
                self.front = self.back = None
            elif first in (38, 48):
                kind = numbers.pop(0)
                colour = tuple(numbers[:3]) if kind == 2 else of_256(numbers[0])
                del numbers[:3 if kind == 2 else 1]
                self.front, self.back = (colour, self.back) if first == 38 else (self.front, colour)
            elif first == 39:
                self.front = None

    def characters(self, text):
        if not self.modes.get(1049):
            self.on_main_screen += text.encode()
            return
        row, column = self.cursor
        for character in text:
            if 0x300 <= ord(character) < 0x10000 and character not in "▀" and is_mark(character):
                self.cells[row, column - 1] = (self.cells[row, column - 1][0] + character, *self.cells[row, column - 1][1:])
                continue
            if column >= self.size[0]:
                self.errors.append(f"a character beyond the last column, row {row}")
            self.cells[row, column] = (character, self.front, self.back)
            column += 1
        self.cursor = [row, column]

    def string(self, kind, text):
        if kind == b"P" and text == b"$qm":
            if self.true_colour and not self.tmux:
                self.reply(b"\x1bP1$r48:2:%d:%d:%dm\x1b\\" % self.back)
        elif kind == b"P" and re.match(rb"[0-9;]*q", text):
            self.sixel_bytes.append(len(text) + 4)
            self.pictures.append(decode_sixel(text))
            if self.cursor != [0, 0]:
                self.errors.append("a sixel picture that is not at the upper left")
        elif kind == b"_" and text.startswith(b"G"):
            self.graphics(text[1:])

    def graphics(self, text):
        control, _, payload = text.partition(b";")
        keys = dict(pair.split(b"=", 1) for pair in control.split(b","))
        if len(payload) > 4096:
            self.errors.append("a chunk of more than 4096 bytes")
        if self.loading is not None and keys.get(b"a") == b"d":
            self.loading = None
        if self.loading is not None:
            self.loading[1] += payload
        elif keys.get(b"a") == b"q":
            if self.kitty:
                self.reply(b"\x1b_Gi=%s;OK\x1b\\" % keys[b"i"])
            return
        elif keys.get(b"a") == b"d":
            self.images.pop(int(keys[b"i"]), None)
            return
        else:
            self.loading = [keys, payload]
        if keys.get(b"m") == b"1":
            return
        keys, payload = self.loading
        self.loading = None
        width, height = int(keys[b"s"]), int(keys[b"v"])
        pixels = base64.b64decode(payload, validate=True)
        if keys.get(b"o") == b"z":
            pixels = zlib.decompress(pixels)
        if keys[b"f"] != b"24" or len(pixels) != 3 * width * height:
            self.errors.append(f"a picture of {len(pixels)} bytes for {keys}")
        self.images[int(keys[b"i"])] = (width, height, pixels)
        self.pictures.append((width, height, pixels))
        if b"U" in keys:
            self.placed.append((int(keys[b"i"]), int(keys[b"c"]), int(keys[b"r"])))
        if b"q" not in keys:
            self.frame(b"\x1b_Gi=%s;%s\x1b\\" % (keys[b"i"], self.refuses or b"OK"))

    def frame(self, answer):
        """A frame is there; its answer is due."""
        self.frames += 1
        if self.holds:
            self.held.append(answer)
        else:
            self.reply(answer)

    def answer_frame(self):
        self.reply(self.held.pop(0))

    # ---- What it shows

    def half_blocks(self):
        """(upper, lower) colours by (row, column), of the cells without letters."""
        shown = {}
        for place, (character, front, back) in self.cells.items():
            if character == "▀":
                shown[place] = (front, back)
            elif character == " ":
                shown[place] = (back, back)
        return shown

    def text(self):
        rows = [""] * self.size[1]
        for (row, column), (character, _, _) in sorted(self.cells.items()):
            rows[row] += character.replace("▀", " ")
        return "\n".join(rows)

    def is_as_before(self):
        """None, or what a program that has left changed."""
        changed = {mode: on for mode, on in self.modes.items() if on != (mode in SAVED)}
        if changed:
            return f"modes {changed}"
        if self.images or self.loading:
            return f"pictures in memory: {list(self.images)}"
        if self.front or self.back:
            return "colours"
        if self.line_modes() != self.first_modes:
            return f"the line: {self.line_modes()} where it was {self.first_modes}"
        return None


def is_mark(character):
    import unicodedata
    return unicodedata.combining(character) != 0


def of_256(number):
    levels = (0, 95, 135, 175, 215, 255)
    if number >= 232:
        return (8 + 10 * (number - 232),) * 3
    number -= 16
    return levels[number // 36], levels[number // 6 % 6], levels[number % 6]


SIXEL = re.compile(rb'"([0-9;]+)|#(\d+);2;(\d+);(\d+);(\d+)|#(\d+)|!(\d+)([?-~])|([?-~])|([$-])')


def decode_sixel(text):
    """(width, height, RGB) of a sixel picture, every pixel of which is painted."""
    body = text[text.index(b"q") + 1:]
    colours, width, height, pixels, x, y, colour = {}, 0, 0, None, 0, 0, None
    for size, define, r, g, b, select_, count, repeated, single, move in SIXEL.findall(body):
        if size:
            width, height = [int(n) for n in size.split(b";")][2:]
            pixels = [None] * (width * height)
        elif define:
            colours[int(define)] = tuple((int(level) * 255 + 50) // 100 for level in (r, g, b))
        elif select_:
            colour = colours[int(select_)]
        elif move:
            x, y = 0, y + 6 if move == b"-" else y
        else:
            bits, run = (repeated or single)[0] - 63, int(count or 1)
            for row in range(6):
                if bits >> row & 1:
                    start = (y + row) * width + x
                    pixels[start:start + run] = [colour] * run
            x += run
    assert len(pixels) == width * height and None not in pixels, "a pixel outside, or one that is not painted"
    return width, height, bytes(level for pixel in pixels for level in pixel)


def read_ppm(path):
    with open(path, "rb") as file:
        data = file.read()
    width, height = (int(n) for n in data.split(b"\n", 3)[1].split())
    return width, height, data[-3 * width * height:]
