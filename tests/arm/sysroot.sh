#!/usr/bin/env bash
# sysroot.sh FOLDER: Debian's arm64 libraries of the render core and its tests, unpacked into FOLDER. apt works on a
# state of its own under FOLDER, as on a bare arm64 machine: this machine's packages and architectures stay as they are.
# With the folder filled it uses no network.
set -euo pipefail
source "$(dirname "$(readlink -f "$0")")/../../scripts/packages.sh"
packages=(libc6-dev libstdc++-12-dev "${libraries_core[@]}" "${libraries_test[@]}")
[ "$(cat "$1/packages" 2>/dev/null)" = "${packages[*]}" ] && exit 0
rm -rf "$1"
mkdir -p "$1"/apt/lists/partial "$1"/apt/archives/partial
folder=$(readlink -f "$1")
touch "$folder/apt/status" # nothing is installed
cat >"$folder/apt/conf" <<EOF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "$(id -un)";
Dir::State "$folder/apt";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt";
EOF
as_root=() # apt's folders are ours
export APT_CONFIG=$folder/apt/conf
echo "sysroot.sh: fetching ${#packages[@]} packages for arm64 and what they need (35 MB, once)" >&2
apt_get update
apt_get install --no-install-recommends --download-only "${packages[@]}"
for package in "$folder"/apt/archives/*.deb; do
    dpkg-deb -x "$package" "$folder"
done
# Absolute links would lead to this machine's own libraries.
find "$folder" -type l -lname '/*' -printf '%p %l\n' | while read -r link target; do
    ln -sfr "$folder$target" "$link"
done
rm -rf "$folder/apt"
echo "${packages[*]}" >"$folder/packages" # last: the folder is whole
