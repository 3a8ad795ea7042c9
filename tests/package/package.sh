#!/usr/bin/env bash
# package.sh ROOT: the Debian package is made, lintian finds nothing in it, and it installs, runs and goes again in a
# chroot that has nothing but Debian's base: the same picture as the program that was built.
set -euo pipefail
root=$1
deb=$(cd "$root" && scripts/package.sh | tail -n 1)
deb=$root/$deb
lintian --fail-on error,warning "$deb"

chroot=$(mktemp -d)
trap 'umount "$chroot/proc" 2>/dev/null || true; rm -rf "$chroot"' EXIT
# Not every machine has both kinds of lists.
mirror=$({ cat /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources} 2>/dev/null || true; } |
    sed -n '/^\(deb\|URIs:\) *\(\[[^]]*\] *\)\?\(http[^ ]*\).*/{s//\3/p;q}')
debootstrap --variant=minbase bookworm "$chroot" "${mirror:-http://deb.debian.org/debian}" >"$root/build/debootstrap.log" 2>&1 || {
    tail "$root/build/debootstrap.log"
    exit 1
}
mount -t proc proc "$chroot/proc"
cp "$deb" "$chroot/tmp/scanout.deb"
cp /etc/resolv.conf "$chroot/etc/resolv.conf"
within() { chroot "$chroot" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive HOME=/root "$@"; }
within apt-get -q -y install --no-install-recommends /tmp/scanout.deb >"$root/build/chroot.log" 2>&1 || {
    tail "$root/build/chroot.log"
    exit 1
}
got=$(within scanout render /usr/share/scanout/models/spot/spot.obj --hash)
expected=$("$root/build/release/scanout" render "$root/models/spot/spot.obj" --hash)
[ "$got" = "$expected" ] || { echo "another picture: $got, not $expected"; exit 1; }
for file in share/man/man1/scanout.1.gz share/bash-completion/completions/scanout share/zsh/vendor-completions/_scanout \
    share/fish/vendor_completions.d/scanout.fish libexec/scanout/console-guard share/thumbnailers/scanout.thumbnailer share/doc/scanout/copyright; do
    [ -s "$chroot/usr/$file" ] || { echo "/usr/$file was not installed"; exit 1; }
done
# As a desktop's thumbnailer would call it: no home, no display.
line=$(sed -n 's/^Exec=//p' "$chroot/usr/share/thumbnailers/scanout.thumbnailer")
line=${line//%i//usr/share/scanout/models/spot/spot.obj}
line=${line//%o//tmp/thumbnail}
within sh -c "unset HOME; ${line//%s/128}"
[ "$(head -c 8 "$chroot/tmp/thumbnail" | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a ] || { echo "no thumbnail"; exit 1; }
within apt-get -q -y purge scanout >/dev/null 2>&1
left=$(find "$chroot/usr" -name '*scanout*')
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
