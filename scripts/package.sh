#!/usr/bin/env bash
# scripts/package.sh: builds a release, as ./run does, and the Debian package of it: build/scanout_VERSION_ARCHITECTURE.deb.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
cd "$root"
source scripts/packages.sh
need build package
./run version >&2 # builds build/release
ninja -C build/release >&2
(cd build/release && rm -f ./*.deb && cpack -G DEB >cpack.log) || {
    cat build/release/cpack.log >&2
    exit 1
}
mv build/release/*.deb build/
echo build/scanout_*.deb
