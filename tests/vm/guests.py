#!/usr/bin/env python3
"""guests.py SCANOUT [FOLDER] [GUEST...] - the viewer on real displays, seen and handled from outside.

In each guest: text stands on the console; `scanout view` starts; keys are pressed, the mouse is moved; the screen is
photographed in several states; the viewer ends in several ways, and the text and the keyboard must be back. The actions
that the viewer recorded in the guest are replayed on the host without a display: every photograph must be, to the last
bit, the frame that this replay shows. Photographs and logs stay in FOLDER (default: guests).
"""
import pathlib
import re
import subprocess
import sys
import time

import guest as guests
import initramfs
import picture
import ways_out

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODEL = "models/spot/spot.obj"
VIEW = [MODEL, "--camera", "150,20", "--no-pointer"]  # it hides after a time
INPUT = {"virtio_pci": "", "virtio_input": "", "evdev": ""}
# name: kernel modules with their parameters, QEMU's devices, the viewer's backend, the display's pixel format.
# A photograph of a 16-bit screen has 8 bits a channel, whose lower bits QEMU fills with the channel's highest ones
# (pixman's r5g6b5 to x8r8g8b8): what `--pixel-format rgb565` shows too.
GUESTS = {
    "virtio-gpu": (INPUT | {"virtio_gpu": ""}, ["-vga", "none", "-device", "virtio-gpu-pci,xres=640,yres=480"],
                   "drm", "xrgb8888"),
    "cirrusfb": (INPUT | {"cirrusfb": "mode_option=640x480-16@60"}, ["-vga", "cirrus"], "fbdev", "rgb565"),
}
FRAME = r"^frame \d+ hash (\w{16}) \S+$"


def turn_by_keys(guest):
    for name in ("left", "left", "left", "up", "up", "equal"):
        guest.key(name)


def look_from_the_side_without_perspective(guest):
    guest.key("3")
    guest.key("5")


def open_the_help_sheet(guest):
    guest.key("h")


def close_it_and_turn_by_mouse(guest):
    guest.key("h")
    guest.button("left", True)
    for step in ((40, 0), (35, 10), (-5, 30)):
        guest.move(*step)
        time.sleep(0.05)
    guest.button("left", False)


def scale_by_wheel(guest):
    guest.move(60, -40)
    for direction in ("up", "up", "down"):
        guest.wheel(direction)


# What is done from outside, and the action that the viewer takes last.
STATES = {
    turn_by_keys: "scale_up",
    look_from_the_side_without_perspective: "toggle_projection",
    open_the_help_sheet: "toggle_help",
    close_it_and_turn_by_mouse: "drag_end",
    scale_by_wheel: r"zoom_at -\d+ 450 240",
}


class Checks:
    def __init__(self):
        self.passed = self.failed = 0

    def __call__(self, good, what, detail=""):
        self.passed, self.failed = self.passed + bool(good), self.failed + (not good)
        print(f"{'ok    ' if good else 'FAILED'} {what}{'' if good or not detail else ': ' + detail}", flush=True)


class Viewer:
    """scanout in a guest, on its first console."""

    def __init__(self, guest, backend, *arguments, view=VIEW):
        self.guest = guest
        guest.sh(f"(setsid scanout view {' '.join(view)} --backend {backend} --verbose {' '.join(arguments)} "
                 "</dev/tty1 >/dev/tty1 2>/dev/ttyS0; echo @exit $?) &")
        guest.wait(r"^input .*2 devices", 60) # keys pressed earlier would be lost
        self.first = self.shown()

    def shown(self, last_action=None):
        """The hash of the frame on the screen, once it shows what this action and those before it ask for."""
        start = self.guest.position
        if last_action:
            self.guest.wait(rf"^action \d+ {last_action}$")
        self.guest.wait(r"^settled$")
        frames = re.findall(FRAME, self.guest.said_since(start), re.M)
        if not frames:
            raise guests.GuestError("the viewer has settled without a new frame")
        return frames[-1]

    def exit_status(self):
        return int(self.guest.wait(r"^@exit (\d+)$", 20)[0])


def check_states(guest, viewer, check):
    """Goes through the states; returns [(state, photograph, lines that the recording has by then)]."""
    taken = []
    for act, last_action in [(None, None), *STATES.items()]:
        state = act.__name__ if act else "start"
        if act:
            act(guest)
        told = viewer.shown(last_action) if act else viewer.first
        shot = guest.photograph(state)
        check(picture.frame_hash(shot) == told, f"{state}: the screen shows the frame that the viewer names")
        taken.append((state, shot, int(guest.sh("wc -l </tmp/actions").split()[-1])))
    distinct = {shot for _, shot, _ in taken}
    check(len(distinct) == len(taken), "the states are different pictures")
    return taken


def check_pointer(guest, backend, check):
    """The pointer shows when the mouse moves, and hides again."""
    viewer = Viewer(guest, backend, "--no-times", view=[arg for arg in VIEW if arg != "--no-pointer"])
    guest.move(40, 30)
    moved = viewer.shown(r"pointer -?\d+ -?\d+")
    hidden = viewer.shown()
    check(moved != viewer.first and hidden == viewer.first, "the pointer shows when the mouse moves, and hides again",
          f"{viewer.first} {moved} {hidden}")
    guest.key("q")
    viewer.exit_status()


def check_replay(scanout, folder, recording, taken, pixel_format, check):
    """Replays the recording on the host and holds its frames against the photographs."""
    lines = recording.splitlines()
    script = []
    for count, line in enumerate(lines, 1):
        script.append(line)
        script += [f"frame {state}-replayed.ppm" for state, _, by_then in taken if by_then == count]
    (folder / "actions.txt").write_text("\n".join(script) + "\n")
    replay = subprocess.run([scanout, "view", ROOT / MODEL, *VIEW[1:], "--backend", "headless", "--size", "640x480",
                             "--pixel-format", pixel_format, "--replay", "actions.txt"],
                            cwd=folder, capture_output=True, text=True, timeout=60)
    check(replay.returncode == 0, "the host replays the recording without a display", replay.stderr)
    hashes = dict(re.findall(r"^frame (\S+)-replayed.ppm hash (\w{16})$", replay.stdout, re.M))
    for state, shot, _ in taken:
        check(picture.frame_hash(shot) == hashes.get(state), f"{state}: the photograph is the replayed frame",
              picture.differences(shot, picture.read_ppm(folder / f"{state}-replayed.ppm")) if state in hashes
              else "the replay wrote no such frame")
    check_that_one_pixel_matters(scanout, folder, *taken[-1][:2], check)


def check_that_one_pixel_matters(scanout, folder, state, shot, check):
    spoilt = bytearray(shot.rgb)
    spoilt[3 * (240 * shot.width + 320)] ^= 8 # the lowest bit of red that 16 bits have
    picture.write_ppm(folder / "spoilt.ppm", shot._replace(rgb=bytes(spoilt)))
    compare = [scanout, "compare", f"{state}-replayed.ppm"]
    same = subprocess.run([*compare, f"{state}.ppm"], cwd=folder, capture_output=True)
    other = subprocess.run([*compare, "spoilt.ppm"], cwd=folder, capture_output=True)
    check((same.returncode, other.returncode) == (0, 22), "one changed pixel in a photograph is seen",
          f"compare ended with {same.returncode} and {other.returncode}")
    check(picture.frame_hash(shot) != picture.frame_hash(picture.read_ppm(folder / "spoilt.ppm")),
          "one changed pixel gives another hash")


def check_text(guest, before, how, check):
    """The console's text as it was before the viewer."""
    after = guest.photograph(f"console-after-{how}")
    patience = time.monotonic() + 5  # after SIGKILL another process restores the console
    while after != before and time.monotonic() < patience:
        time.sleep(0.2)
        after = guest.photograph(f"console-after-{how}")
    check(after == before, f"after {how}: the console's text is back", picture.differences(after, before))
    return after


def check_console(guest, before, how, check):
    """The console as it was before the viewer: its text, and a keyboard that writes on it, with no key left over."""
    after = check_text(guest, before, how, check)
    guest.sh("until vm_helper mode /dev/tty1 | grep -q 'text on'; do usleep 10000; done")
    guest.sh("(head -n 1 </dev/tty1 | sed 's/^/@typed /') &")
    for name in ("o", "k", "ret"):
        guest.key(name)
    typed = guest.wait(r"^@typed (.*)$", 10)[0]
    check(typed == "ok", f"after {how}: the keyboard writes, and no key of the viewer's is left over", repr(typed))
    check(guest.photograph(f"typed-after-{how}") != after, f"after {how}: what is typed is seen")


def write_text(guest):
    guest.sh(r"printf '\033[2J\033[H\033[?25lThis text stood here before.\n' >/dev/tty1")
    # The kernel's console reaches the screen by a worker, some time later.
    shots = [guest.photograph("console-before")]
    while len(shots) < 3 or len(set(shots[-3:])) > 1:
        time.sleep(0.2)
        shots.append(guest.photograph("console-before"))
    return shots[-1]


def check_guest(scanout, folder, name, check):
    modules, devices, backend, pixel_format = GUESTS[name]
    cache = pathlib.Path(subprocess.run([ROOT / "tests/vm/fetch.sh"], check=True, capture_output=True, text=True).stdout.strip())
    model = str(pathlib.Path(MODEL).parent)
    archive = initramfs.pack(cache, modules, [scanout, scanout.parent / "console-guard", scanout.parent / "tests/vm_helper"], {
        model: ROOT / model, "usr/share/X11/xkb": "/usr/share/X11/xkb", "usr/share/libinput": "/usr/share/libinput"})
    with guests.Guest(cache / "vmlinux", archive, devices, folder) as guest:
        before = write_text(guest)
        check(any(before.rgb), "text stands on the console")
        viewer = Viewer(guest, backend, "--record", "/tmp/actions")
        taken = check_states(guest, viewer, check)
        guest.key("q")
        check(viewer.exit_status() == 0, "Q ends the viewer with status 0")
        check_console(guest, before, "Q", check)
        check_replay(scanout, folder, guest.sh("cat /tmp/actions"), taken, pixel_format, check)
        for signal in ("TERM", "KILL"):
            check(write_text(guest) == before, f"before {signal}: the same text stands on the console")
            viewer = Viewer(guest, backend, "--no-times") # its first picture has no line about the keys
            again = guest.photograph(f"before-{signal}")
            check(again == taken[0][1], f"before {signal}: the viewer shows its first picture again",
                  picture.differences(again, taken[0][1]))
            # The first process: its guard and its seat's server are forks of it.
            guest.sh(f"kill -{signal} $(ps -o pid,comm | awk '$2 == \"scanout\" {{ print $1; exit }}')")
            viewer.exit_status()
            check_console(guest, before, signal, check)
        write_text(guest)
        check_pointer(guest, backend, check)
        check_console(guest, before, "the pointer", check)
        ways_out.check_all(guest, Session(guest, backend, before, taken[0][1], check))


class Session:
    """What the checks of ways_out.py start and look at."""

    def __init__(self, guest, backend, text, first_picture, check):
        self.guest, self.backend, self.text, self.first_picture, self.check = guest, backend, text, first_picture, check

    def view(self, *arguments):
        self.check(write_text(self.guest) == self.text, "the same text stands on the console")
        return Viewer(self.guest, self.backend, "--no-times", *arguments)

    def text_is_back(self, how):
        check_text(self.guest, self.text, how, self.check)

    def console_is_back(self, how):
        check_console(self.guest, self.text, how, self.check)

    def shows_first_picture(self, when):
        shot, patience = self.guest.photograph(when.replace(" ", "-")), time.monotonic() + 5
        while shot != self.first_picture and time.monotonic() < patience:
            time.sleep(0.2)
            shot = self.guest.photograph(when.replace(" ", "-"))
        self.check(shot == self.first_picture, f"{when}: the viewer shows its first picture",
                   picture.differences(shot, self.first_picture))


def main():
    scanout = pathlib.Path(sys.argv[1]).resolve()
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "guests")
    check = Checks()
    for name in sys.argv[3:] or GUESTS:
        start = time.monotonic()
        print(f"{name}:")
        try:
            check_guest(scanout, folder / name, name, check)
        except guests.GuestError as error:
            check(False, "the guest does what the test waits for", str(error))
        print(f"{name}: {time.monotonic() - start:.1f} s")
    print(f"{check.passed} passed, {check.failed} failed")
    sys.exit(check.failed > 0 or check.passed == 0)


if __name__ == "__main__":
    main()
