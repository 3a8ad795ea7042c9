"""Packs a guest's file system: busybox, programs with their shared libraries, kernel modules, files."""
import pathlib
import re
import subprocess

BUSYBOX = "/bin/busybox"


class Cpio:
    """An archive in the kernel's format (Documentation/driver-api/early-userspace/buffer-format.rst)."""

    def __init__(self):
        self._out = bytearray()
        self._names = set()

    def _entry(self, name, mode, data=b""):
        self._names.add(name)
        encoded = name.encode() + b"\0"
        fields = [len(self._names), mode, 0, 0, 1, 0, len(data), 0, 0, 0, 0, len(encoded), 0]
        self._out += b"070701" + b"".join(b"%08X" % field for field in fields) + encoded
        self._out += bytes(-len(self._out) % 4) + data
        self._out += bytes(-len(self._out) % 4)

    def __contains__(self, path):
        return path.strip("/") in self._names

    def folder(self, path):
        parts = path.strip("/").split("/")
        for end in range(1, len(parts) + 1):
            name = "/".join(parts[:end])
            if name and name not in self._names:
                self._entry(name, 0o040755)

    def file(self, path, data, mode=0o755):
        if path not in self:
            self.folder(str(pathlib.PurePosixPath(path).parent))
            self._entry(path.strip("/"), 0o100000 | mode, data)

    def link(self, path, target):
        self._entry(path.strip("/"), 0o120777, target.encode())

    def tree(self, path, source):
        source = pathlib.Path(source)
        for found in [source] if source.is_file() else sorted(p for p in source.rglob("*") if p.is_file()):
            self.file(str(pathlib.PurePosixPath(path) / found.relative_to(source)), found.read_bytes())

    def bytes(self):
        self._entry("TRAILER!!!", 0)
        return bytes(self._out)


def libraries(program):
    """Paths of the shared libraries that a program loads."""
    listed = subprocess.run(["ldd", str(program)], capture_output=True, text=True, check=True).stdout
    return re.findall(r"(?:=> |^\s*)(/\S+) \(", listed, re.M)


def module_files(kernel_modules, names):
    """The named modules and what they need, in the order in which they are loaded."""
    needs = {}
    for line in (kernel_modules / "modules.dep").read_text().splitlines():
        path, _, deps = line.partition(":")
        needs[path] = deps.split()
    by_name = {pathlib.PurePath(path).stem.replace("-", "_"): path for path in needs}
    ordered = []
    for name in names:
        path = by_name[name.replace("-", "_")]
        ordered += [p for p in [*reversed(needs[path]), path] if p not in ordered]
    return [kernel_modules / path for path in ordered]


def pack(cache, modules, programs, files):
    """The archive. modules: {name of a kernel module: its parameters}, loaded in order; programs: host paths, they
    stand in /bin; files: {path in the guest: file or folder of the host}."""
    cache = pathlib.Path(cache)
    out = Cpio()
    for folder in ("dev", "proc", "sys", "tmp", "run", "etc"):
        out.folder(folder)
    out.file("init", (pathlib.Path(__file__).parent / "init").read_bytes())
    out.file("etc/passwd", b"root:x:0:0:root:/:/bin/sh\n", 0o644)
    out.file("bin/busybox", pathlib.Path(BUSYBOX).read_bytes())
    for applet in subprocess.run([BUSYBOX, "--list"], capture_output=True, text=True, check=True).stdout.split():
        if applet != "busybox":
            out.link(f"bin/{applet}", "busybox")
    for program in programs:
        out.file(f"bin/{pathlib.Path(program).name}", pathlib.Path(program).read_bytes())
        for library in libraries(program):
            out.file(library, pathlib.Path(library).read_bytes())
    version = (cache / "version").read_text().strip()
    load = ""
    for path in module_files(cache / "lib/modules" / version, modules):
        out.file(f"modules/{path.name}", path.read_bytes())
        load += f"insmod /modules/{path.name} {modules.get(path.stem, '')} || echo '@failed {path.name}'\n"
    out.file("modules/load", load.encode())
    for path, source in files.items():
        out.tree(path, source)
    return out.bytes()
