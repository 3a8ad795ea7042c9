"""One guest under QEMU: its serial line as a shell, keys and mouse from outside, photographs of its screen."""
import json
import os
import pathlib
import re
import socket
import subprocess
import threading
import time

import picture


class GuestError(Exception):
    pass


class Qmp:
    """QEMU's monitor (docs/interop/qmp-spec.rst)."""

    def __init__(self, path, seconds):
        deadline = time.monotonic() + seconds
        self._socket = socket.socket(socket.AF_UNIX)
        while True:
            try:
                self._socket.connect(path)
                break
            except OSError:
                if time.monotonic() > deadline:
                    raise GuestError("QEMU opened no monitor")
                time.sleep(0.01)
        self._file = self._socket.makefile("rwb")
        self._file.readline()
        self.command("qmp_capabilities")

    def command(self, name, **arguments):
        self._file.write(json.dumps({"execute": name, "arguments": arguments}).encode() + b"\n")
        self._file.flush()
        for line in self._file:
            answer = json.loads(line)
            if "return" in answer:
                return answer["return"]
            if "error" in answer:
                raise GuestError(f"{name}: {answer['error']['desc']}")
        raise GuestError("QEMU closed its monitor")


class Guest:
    """with Guest(...) as guest: boots it; leaving the block ends it. `folder` gets serial.log and the photographs."""

    def __init__(self, kernel, initramfs, devices, folder, append=""):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        archive = self.folder / "initramfs.cpio"
        archive.write_bytes(initramfs)
        monitor = self.folder / "qmp.sock"
        monitor.unlink(missing_ok=True)
        # TCG: nested KVM is often absent, and the boot takes 2 s without it. `-cpu max`: the default CPU has no SSSE3.
        # Without AVX2: QEMU 7.2 gathers from wrong places where ymm4 holds the indices.
        # No PS/2 controller: QEMU would send the keys there.
        self._qemu = subprocess.Popen(
            ["qemu-system-x86_64", "-M", "q35,i8042=off", "-accel", "tcg,thread=multi", "-cpu", "max,-avx2", "-m", "512",
             "-nodefaults", "-no-user-config", "-display", "none", "-no-reboot", "-serial", "stdio",
             "-qmp", f"unix:{os.path.relpath(monitor)},server=on,wait=off", "-kernel", str(kernel), "-initrd", str(archive),
             "-append", f"console=ttyS0 panic=-1 quiet {append}",
             "-device", "virtio-keyboard-pci", "-device", "virtio-mouse-pci", *devices],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self._serial = bytearray()
        self.position = 0  # on the serial line: what stands before it has been waited for
        self._ended = False
        self._changed = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self._monitor_path = os.path.relpath(monitor)

    def __enter__(self):
        try:
            self._qmp = Qmp(self._monitor_path, 10)
            self.wait(r"^@ready", 60)
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._qemu.terminate()
        try:
            self._qemu.wait(5)
        except subprocess.TimeoutExpired:
            self._qemu.kill()
            self._qemu.wait()
        self._reader.join(5)
        (self.folder / "initramfs.cpio").unlink(missing_ok=True)

    def _read(self):
        with open(self.folder / "serial.log", "wb") as log:
            while True:
                data = os.read(self._qemu.stdout.fileno(), 65536)
                log.write(data)
                log.flush()
                with self._changed:
                    self._serial += data.replace(b"\r", b"")
                    self._ended = not data
                    self._changed.notify_all()
                if not data:
                    return

    # --- the serial line

    def wait(self, pattern, seconds=30):
        """The next match on the serial line after the last one that was waited for."""
        compiled = re.compile(pattern.encode(), re.M)
        deadline = time.monotonic() + seconds
        with self._changed:
            while True:
                match = compiled.search(self._serial, self.position)
                if match:
                    self.position = match.end()
                    return tuple(group.decode() for group in match.groups())
                left = deadline - time.monotonic()
                if left <= 0 or self._ended:
                    tail = self._serial[self.position:][-2000:].decode(errors="replace")
                    raise GuestError(f"{'the guest ended' if self._ended else f'{seconds} s passed'} without "
                                     f"/{pattern}/; the serial line since: {tail or '(nothing)'}")
                self._changed.wait(left)

    def said_since(self, position):
        return self._serial[position:self.position].decode(errors="replace")

    def sh(self, command, seconds=30):
        """Runs one line in the guest's shell; returns its output. A status other than 0 is an error."""
        self._qemu.stdin.write(command.encode() + b"\n")
        self._qemu.stdin.flush()
        self.wait(r"^@begin\n", seconds)
        start = self.position
        (status,) = self.wait(r"^@done (\d+)$", seconds)
        output = self.said_since(start).rsplit("@done", 1)[0]
        if status != "0":
            raise GuestError(f"`{command}` ended with {status}: {output}")
        return output

    # --- hands

    def _send(self, *events):
        self._qmp.command("input-send-event", events=list(events))

    def key(self, *names):
        """Presses the keys together and lets them go, e.g. key("shift", "left") (QEMU's QKeyCode names)."""
        for pressed, ordered in ((True, names), (False, names[::-1])):
            for name in ordered:
                self._send({"type": "key", "data": {"down": pressed, "key": {"type": "qcode", "data": name}}})
                time.sleep(0.02)

    def move(self, dx, dy):
        self._send(*({"type": "rel", "data": {"axis": a, "value": v}} for a, v in (("x", dx), ("y", dy)) if v))

    def button(self, name, pressed):
        """left, middle, right, wheel-up, wheel-down. libinput holds back a button let go within a few ms."""
        self._send({"type": "btn", "data": {"down": pressed, "button": name}})
        time.sleep(0.06)

    def wheel(self, direction):
        self.button(f"wheel-{direction}", True)
        self.button(f"wheel-{direction}", False)

    # --- eyes

    def photograph(self, name):
        path = self.folder / f"{name}.ppm"
        self._qmp.command("screendump", filename=str(path.resolve()))
        return picture.read_ppm(path)
