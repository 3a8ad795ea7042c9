"""A guest on a CPU with AVX-512, emulated by Bochs: boots, runs GoogleTest programs, and is ended."""
import pathlib
import shutil
import struct
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "vm"))
import initramfs  # noqa: E402

MEMORY = 512 << 20
END = "@end"
PVH_ENTRY = 18  # XEN_ELFNOTE_PHYS32_ENTRY
# `model`: Highway's AVX3 and nothing above it. The rates of CPU and clock are tied to each other, not to the host's
# time; `ips` only says how many instructions go by between two interrupts of the timer.
CONFIGURATION = """\
display_library: term
cpu: model=corei7_skylake_x, ips=50000000, reset_on_triple_fault=0
memory: guest={memory}, host={memory}
romimage: file={folder}/reset.rom
vgaromimage: file=/usr/share/vgabios/vgabios.bin
optramimage1: file={folder}/memory, address={address:#x}
pci: enabled=0
com1: enabled=1, mode=file, dev={serial}
log: {folder}/bochs.log
panic: action=fatal
clock: sync=none
"""


class Unavailable(Exception):
    """The guest cannot be had on this machine."""


def flat_kernel(vmlinux):
    """(address, bytes, PVH entry) of an ELF kernel as it lies in memory, its cleared parts included."""
    (headers,), (count,) = struct.unpack_from("<Q", vmlinux, 32), struct.unpack_from("<H", vmlinux, 56)
    loads, entry = [], None
    for i in range(count):
        kind, _, offset, _, address, size, in_memory, _ = struct.unpack_from("<IIQQQQQQ", vmlinux, headers + 56 * i)
        if kind == 1:  # PT_LOAD
            loads.append((address, vmlinux[offset:offset + size], in_memory))
        if kind == 4:  # PT_NOTE
            entry = entry or pvh_entry(vmlinux[offset:offset + size])
    if not loads or entry is None:
        raise Unavailable("the kernel has no PVH entry")
    start = min(address for address, _, _ in loads)
    image = bytearray(max(address + in_memory for address, _, in_memory in loads) - start)
    for address, data, _ in loads:
        image[address - start:address - start + len(data)] = data
    return start, image, entry


def pvh_entry(notes):
    at = 0
    while at < len(notes):
        name_size, size, kind = struct.unpack_from("<III", notes, at)
        data = at + 12 + (name_size + 3) // 4 * 4
        if notes[at + 12:at + 16] == b"Xen\0" and kind == PVH_ENTRY:
            return int.from_bytes(notes[data:data + size], "little")
        at = data + (size + 3) // 4 * 4
    return None


def file_system(programs, data, folder):
    out = initramfs.Cpio()
    for path in ("dev", "proc", "tmp"):
        out.folder(path)
    out.file("bin/busybox", pathlib.Path(initramfs.BUSYBOX).read_bytes())
    subprocess.run(["g++", "-std=c++20", "-O2", "-shared", "-fPIC", "-o", folder / "gather.so", HERE / "gather.cpp"],
                   check=True)
    out.file("bin/gather.so", (folder / "gather.so").read_bytes())
    # LD_BIND_NOW: binding a function at its first call saves the vector registers, and XRSTOR in Bochs 2.7 does not
    # always take back what XSAVEC wrote.
    script = ["#!/bin/busybox sh", "busybox mount -t devtmpfs dev /dev", "busybox mount -t proc proc /proc",
              "exec </dev/null >/dev/ttyS0 2>&1", "export LD_BIND_NOW=1 LD_PRELOAD=/bin/gather.so GTEST_COLOR=no"]
    for program, cases in programs.items():
        stripped = folder / program.name
        subprocess.run(["objcopy", "--strip-debug", program, stripped], check=True)
        out.file(f"bin/{program.name}", stripped.read_bytes())
        for library in initramfs.libraries(program):
            out.file(library, pathlib.Path(library).read_bytes())
        script += [f"{program.name} '--gtest_filter={cases}'", f"echo @exit {program.name} $?"]
    script += [f"echo {END}", "busybox sleep 1000000"]
    out.file("init", "\n".join(script).encode() + b"\n")
    for path in data:  # where the programs look for it
        out.file(str(path), path.read_bytes(), 0o644)
    return out.bytes()


def prepare(programs, data, folder, log):
    """Writes reset.rom, memory and bochsrc."""
    fetched = subprocess.run([HERE.parent / "vm/fetch.sh"], stdout=subprocess.PIPE, text=True)
    if fetched.returncode != 0:
        raise Unavailable("no kernel for the guest: tests/vm/fetch.sh could not fetch it")
    start, image, entry = flat_kernel((pathlib.Path(fetched.stdout.strip()) / "vmlinux").read_bytes())
    image += bytes(-len(image) % 4096)
    archive = file_system(programs, data, folder)
    (folder / "memory").write_bytes(image + archive)
    symbols = {"KERNEL": start, "KERNEL_ENTRY": entry, "INITRAMFS": start + len(image),
               "INITRAMFS_SIZE": len(archive), "MEMORY": MEMORY}
    subprocess.run(["as", "--32", *(f"--defsym={name}={value}" for name, value in symbols.items()),
                    "-o", folder / "reset.o", HERE / "reset.s"], check=True)
    subprocess.run(["objcopy", "-O", "binary", "-j", ".text", folder / "reset.o", folder / "reset.rom"], check=True)
    (folder / "bochsrc").write_text(CONFIGURATION.format(memory=MEMORY >> 20, folder=folder, address=start, serial=log))
    (folder / "commands").write_text("continue\n")  # for the debugger that Debian's Bochs is built with


def run(programs, data, folder, log, seconds):
    """Runs {GoogleTest program: filter} in a guest; log gets what they say. data: files that they read, by the same
    names there. Ends the guest when the programs have ended or the seconds have passed."""
    if shutil.which("bochs") is None:
        raise Unavailable("this CPU has no AVX-512, and there is no Bochs to emulate one")
    folder, log = folder.resolve(), log.resolve()
    prepare(programs, data, folder, log)
    # It writes its screen to stdout, and does not end on SIGTERM; setpriv: it must not outlive this process.
    with open(folder / "screen.txt", "wb") as screen:
        bochs = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", "bochs", "-q", "-f", folder / "bochsrc", "-rc", folder / "commands"],
                                 env={"PATH": "/usr/bin:/bin", "TERM": "vt100"}, stdin=subprocess.DEVNULL,
                                 stdout=screen, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        deadline = time.monotonic() + seconds
        while bochs.poll() is None and f"\n{END}" not in log.read_text(errors="replace"):
            if time.monotonic() > deadline:
                print(f"the guest did not end in {seconds} s")
                break
            time.sleep(0.2)
    finally:
        bochs.kill()
        bochs.wait()
    (folder / "memory").unlink()
