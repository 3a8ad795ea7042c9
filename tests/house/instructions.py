#!/usr/bin/env python3
"""instructions.py PROGRAM: same bits everywhere means no fused multiply-add and no approximate
reciprocal in the program's own code, on any SIMD target (HARD-CASES 65, 66, D1, D2).
Exit code 77 where there is no objdump or the program is not for x86."""
import re
import subprocess
import sys

FORBIDDEN = re.compile(r"\s(v?fn?m(add|sub)\w*|v?rcp(ps|ss|14\w*|28\w*)|v?rsqrt(ps|ss|14\w*|28\w*))\s")
SYMBOL = re.compile(r"^[0-9a-f]+ <(.*)>:$")


def forbidden(listing):
    """{function: instruction} of an objdump listing."""
    found, function = {}, "?"
    for line in listing:
        symbol = SYMBOL.match(line)
        if symbol:
            function = symbol.group(1)
        else:
            hit = FORBIDDEN.search(line + " ")
            if hit:
                found[function] = hit.group(1)
    return found


def self_test():
    listing = ["0000 <f>:", "  10:\tvfmadd213ps (%rax),%ymm1,%ymm2", "0000 <g>:", "  20:\taddps  %xmm1,%xmm2",
               "0000 <h>:", "  30:\trsqrtss %xmm1,%xmm2"]
    assert forbidden(listing) == {"f": "vfmadd213ps", "h": "rsqrtss"}, forbidden(listing)


def main():
    self_test()
    try:
        run = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", sys.argv[1]], capture_output=True,
                             text=True, check=True)
    except (FileNotFoundError, subprocess.CalledProcessError) as error:
        print(f"skipped: objdump: {error}")
        return 77
    if "x86-64" not in run.stdout.split("\n", 4)[1] + run.stdout[:200]:
        print("skipped: not a program for x86-64")
        return 77
    lines = run.stdout.splitlines()
    found = forbidden(lines)
    for function, instruction in sorted(found.items()):
        print(f"{function}: {instruction}: compile it with -ffp-contract=off, and divide or take the root exactly")
    print(f"{len(lines)} lines of code, {len(found)} functions with a forbidden instruction")
    return 1 if found or len(lines) < 100000 else 0


if __name__ == "__main__":
    sys.exit(main())
