#!/usr/bin/env python3
"""kernel_lambdas.py OBJECT...: every lambda of a SIMD target's kernel stands in its loop. Left to the compiler, which
ones do hangs on what else a file holds, and a call for each register made depth 5 % and textures 15 % slower: what
stands in no loop lacks SIMD_LAMBDA (simd/inline-inl.h). Objects or archives of them; plain lanes (EMU128) may be as
they are. Exit code 77 where there is no nm."""
import re
import shutil
import subprocess
import sys

TARGET = re.compile(r"::N_(?!EMU128)[A-Z][A-Z0-9_]*::")
FUNCTION = re.compile(r"^[0-9a-f]+ [tTwWu] (.*)$")
LAMBDA = re.compile(r"::\{lambda\([^{}]*\)#\d+\}::operator\(\)")


def outside(symbols):
    """The lambdas of targets among the functions in a listing of nm -C, and how many functions of targets there are."""
    functions = [hit.group(1) for hit in map(FUNCTION.match, symbols) if hit and TARGET.search(hit.group(1))]
    return sorted({f for f in functions if LAMBDA.search(f) and TARGET.search(f[: LAMBDA.search(f).start()])}), len(functions)


def self_test():
    listing = ["0010 t a::N_AVX3::(anonymous namespace)::f(int)::{lambda(int)#1}::operator()(int) const [clone .isra.0]",
               "0020 t a::N_EMU128::(anonymous namespace)::f(int)::{lambda(int)#1}::operator()(int) const",
               "0030 t a::N_AVX2::(anonymous namespace)::g<hwy::N_AVX2::Simd<float, 8ul, 0> >(int)",
               "0040 T a::f()::{lambda()#1}::operator()() const", "     U a::N_AVX2::f()::{lambda()#1}::operator()() const"]
    assert outside(listing) == ([listing[0][7:]], 2), outside(listing)


def main():
    self_test()
    if shutil.which("nm") is None:
        print("skipped: there is no nm")
        return 77
    found, functions = [], 0
    for path in sys.argv[1:]:
        listing = subprocess.run(["nm", "-C", path], capture_output=True, text=True, check=True).stdout.splitlines()
        lambdas, number = outside(listing)
        functions += number
        found += [f"{path}: {name}: is called for each register; mark it with SIMD_LAMBDA" for name in lambdas]
    print("\n".join(found + [f"{functions} functions of SIMD targets, {len(found)} of them lambdas"]))
    return 1 if found or functions < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
