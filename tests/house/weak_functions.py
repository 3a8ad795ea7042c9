#!/usr/bin/env python3
"""weak_functions.py OBJECT...: an inline function or template that several files use is a weak symbol, and the linker
keeps one of its copies, whichever it meets first. One that was compiled inside a SIMD target's attributes would then
run on CPUs without that target: code of a target may be weak only in that target's own namespace (N_AVX2, ...).
Objects or archives of them. Exit code 77 where there is no nm or objdump, or the objects are not for x86."""
import re
import shutil
import subprocess
import sys

# x86-64 has SSE2. What begins with v is VEX or EVEX; then VEX without v (BMI), and SSE3 to SSE4.2.
BEYOND_BASELINE = re.compile(
    r"^(v[a-z]+\w*|k(mov|or|and|xor|not|shift|unpck|add|test)\w*|andn|bextr|bls(i|r|msk)|bzhi|mulx|pdep|pext|rorx|s(ar|hl|hr)x|"
    r"pshufb|palignr|pabs[bwd]|psign[bwd]|ph(add|sub)\w+|pm(addub|ulhr)sw|p?blend\w+|dpp[sd]|insertps|extractps|"
    r"pmov[sz]x\w+|pm(ulld|uldq|axs[bd]|axu[wd]|ins[bd]|inu[wd])|ptest|round[sp][sd]|pcmp(eqq|gtq|[ei]str\w)|pinsr[bdq]|"
    r"pextr[bdq]|packusdw|mpsadbw|phminposuw|movntdqa|crc32\w?|mov(s[hl]|d)dup|h(add|sub)p[sd]|addsubp[sd]|lddqu)$")
OF_A_TARGET = re.compile(r"\dN_[A-Z][A-Z0-9_]*[A-Z0-9]")  # a namespace in a mangled name
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
WEAK = re.compile(r"^(?:[0-9a-f]+)? +[WVu] (\S+)$")


def weak_symbols(symbols):
    """Names in a listing of nm that the linker may take from another object, of no target's namespace."""
    found = (WEAK.match(line.rstrip()) for line in symbols)
    return {hit.group(1) for hit in found if hit and not OF_A_TARGET.search(hit.group(1))}


def vector_code(listing, names):
    """{function: its first instruction beyond the baseline} of those functions in a listing of objdump."""
    found, function = {}, None
    for line in listing:
        start = FUNCTION.match(line)
        if start:
            # g++ puts the parts of f that it thinks cold, or has changed, into f.cold, f.part.0, ...
            function = start.group(1).split(".")[0]
        elif function in names and line.startswith(" ") and "\t" in line:
            instruction = line.split("\t")[1].split()
            if instruction and BEYOND_BASELINE.match(instruction[0]):
                found.setdefault(function, instruction[0])
    return found


def tool(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def self_test():
    names = weak_symbols(["0000000000000000 W _ZN3std1fEv\n", "0000 T _ZN3std1gEv", "0000 V _ZTV1A", "     w _ZN3std1hEv",
                          "0000 W _ZN7scanout6N_AVX24laneEv", "0000 W _ZStplIN3hwy9N_AVX3_DLEEvv", "0000 u _ZZ1kvE1x"])
    assert names == {"_ZN3std1fEv", "_ZTV1A", "_ZZ1kvE1x"}, names
    listing = ["0000 <f>:", "  10:\tmovaps %xmm1,%xmm2", "  14:\tvaddps %ymm1,%ymm2,%ymm3", "0000 <g>:", "  20:\tvmovd %xmm1,%eax",
               "0000 <h>:", "  30:\taddps  %xmm1,%xmm2", "  34:\tpand %xmm1,%xmm2", "0000 <k.part.0>:", "  40:\tpshufb %xmm1,%xmm2",
               "0000 <l>:", "  50:\tblsr   %rax,%rdx", "0000 <m>:", "  60:\tkmovw  %k1,%eax", "  64:\tret"]
    assert vector_code(listing, set("fhklm")) == {"f": "vaddps", "k": "pshufb", "l": "blsr", "m": "kmovw"}, listing


def main():
    self_test()
    if shutil.which("nm") is None or shutil.which("objdump") is None:
        print("skipped: there is no nm or no objdump")
        return 77
    functions, found, targets = 0, {}, set()
    for path in sys.argv[1:]:
        symbols, listing = tool("nm", path).splitlines(), tool("objdump", "-d", "--no-show-raw-insn", path).splitlines()
        if not any("file format elf64-x86-64" in line for line in listing):
            print(f"skipped: {path} is not for x86-64")
            return 77
        names = weak_symbols(symbols)
        functions += len(names)
        targets.update(re.findall(r"\d(N_AVX2|N_AVX3)(?=\d)", "\n".join(symbols)))
        found.update({name: (path, instruction) for name, instruction in vector_code(listing, names).items()})
    for name, (path, instruction) in sorted(found.items()):
        print(f"{path}: {tool('c++filt', name).strip()}: {instruction}: compiled for a SIMD target, and the linker may keep "
              "this copy for all; move it into that target's namespace, or to where no target is chosen")
    print(f"{functions} weak symbols of no target, {len(found)} with code of a target; kernels of {' '.join(sorted(targets)) or 'none'}")
    return 1 if found or functions < 100 or not targets else 0


if __name__ == "__main__":
    sys.exit(main())
