#!/usr/bin/env bash
# fetch.sh: Debian's own kernel for the guests, unpacked into a cache and not installed on the host. Prints the cache's
# folder. With the cache filled it uses no network; it lies outside the build folders, so that CI can keep it.
# Kept: vmlinux (the ELF inside vmlinuz, which boots 3 s faster than the compressed one), the modules that the guests
# load with what these need, and the file `version`.
set -euo pipefail
cache=${SCANOUT_VM_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/scanout/vm}
if [ -f "$cache/version" ]; then
    echo "$cache"
    exit 0
fi
source "$(dirname "$(readlink -f "$0")")/../../scripts/packages.sh"
mkdir -p "$cache"
work=$(mktemp -d "$cache/fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
newest() { apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/^ *Depends: *\(linux-image-[^ ]*\)$/\1/p'; }
package=$(newest)
if [ -z "$package" ]; then
    apt_get update
    package=$(newest)
fi
echo "fetch.sh: downloading $package (70 MB, once)" >&2
apt-get -qq download "$package"
drivers='./lib/modules/*/kernel/drivers'
dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x --wildcards './boot/vmlinuz-*' './lib/modules/*/modules.*' \
    "$drivers/gpu/drm/*" "$drivers/video/*" "$drivers/virtio/*" "$drivers/input/*" "$drivers/i2c/*"
version=${package#linux-image-}
PATH=$PATH:/usr/sbin:/sbin depmod -b "$work" "$version"
python3 - "boot/vmlinuz-$version" vmlinux <<'PYTHON'
import lzma, sys
packed = open(sys.argv[1], "rb").read()
kernel = lzma.LZMADecompressor().decompress(packed[packed.find(b"\xfd7zXZ\0"):])
assert kernel[:4] == b"\x7fELF"
open(sys.argv[2], "wb").write(kernel)
PYTHON
rm -rf "${cache:?}/vmlinux" "${cache:?}/lib"
mv vmlinux lib "$cache"
echo "$version" >"$cache/version" # last: the cache is whole
echo "$cache"
