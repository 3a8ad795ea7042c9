#!/usr/bin/env python3
"""packages.py SOURCE: scripts/packages.sh on made-up machines: dpkg-query, apt-get and sudo are scripts that keep a log.

`need` must ask for exactly what is missing, also under `set -e` (./run and the stages of ./test have it) and although
dpkg-query fails when it does not know a package; must not ask when nothing is missing; and must say when it cannot.
"""
import os
import subprocess
import sys
import tempfile

SOURCE = os.path.abspath(sys.argv[1])


def run(script, folder, installed=(), knows_all=False, apt_status=0):
    """(exit code, stderr, the apt-get calls) of `script` where these packages are installed."""
    log = os.path.join(folder, "log")
    open(log, "w").close()
    lines = "".join(f"installed {name}\\n" for name in installed)
    for name, text in (("dpkg-query", f"printf '{lines}'; exit {0 if knows_all else 1}"),
                       ("apt-get", f'echo "$@" >>{log}; exit {apt_status}'),
                       ("sudo", 'exec "$@"')):
        path = os.path.join(folder, name)
        with open(path, "w") as file:
            file.write(f"#!/bin/sh\n{text}\n")
        os.chmod(path, 0o755)
    process = subprocess.run(["bash", "-c", f"set -euo pipefail; source {SOURCE}/scripts/packages.sh; {script}"],
                             env={**os.environ, "PATH": folder + ":" + os.environ["PATH"]}, capture_output=True, text=True)
    return process.returncode, process.stderr, open(log).read().splitlines(), process.stdout.split()


def main():
    failed = []

    def expect(right, what):
        if not right:
            failed.append(what)

    with tempfile.TemporaryDirectory() as folder:
        wanted = run('echo "${packages_build[@]}"', folder)[3]
        expect(len(wanted) > 10, "the list of packages for a build")
        for have in ([], wanted[:3]):
            code, error, calls, _ = run("need build", folder, installed=have)
            missing = wanted[len(have):]
            expect(code == 0, f"{len(have)} installed: status {code}")
            expect(calls and calls[-1].endswith(" ".join(["install", "--no-install-recommends", *missing])),
                   f"{len(have)} installed: apt-get calls {calls}")
            expect(f"installing {len(missing)} packages" in error, f"{len(have)} installed: it says {error!r}")
        code, error, calls, _ = run("need build", folder, installed=wanted, knows_all=True)
        expect((code, error, calls) == (0, "", []), f"all installed: status {code}, {error!r}, apt-get calls {calls}")
        code, error, calls, _ = run("need build", folder, apt_status=100)
        expect(code == 1 and "could not install" in error, f"apt-get fails: status {code}, {error!r}")
    for what in failed:
        print(what, file=sys.stderr)
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
