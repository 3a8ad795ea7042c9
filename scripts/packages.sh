# shellcheck shell=bash disable=SC2034  # the lists are read by name
# Debian packages by purpose, and `need PURPOSE...`, which installs what is missing. Sourced by ./run, ./test and
# tests/vm/fetch.sh.
# The libraries are those of cmake/dependencies.cmake and tests/CMakeLists.txt; versions are Debian 12's.

# What the render core and the tests link; tests/arm/sysroot.sh fetches the same for another machine.
libraries_core=(
    libexpected-dev libfmt-dev libhwy-dev libtbb-dev libglm-dev libpng-dev zlib1g-dev libjpeg62-turbo-dev
    libxxhash-dev libstb-dev libutf8proc-dev libsimdjson-dev libmeshoptimizer-dev libdraco-dev
)
libraries_test=(libgtest-dev libgmock-dev librapidcheck-dev libmpfr-dev libgmp-dev)

# Without displays (SCANOUT_DISPLAYS=OFF).
packages_headless=(
    g++ cmake ninja-build pkg-config "${libraries_core[@]}" libcli11-dev nlohmann-json3-dev libtomlplusplus-dev
    libembree-dev libxkbcommon-dev
)
packages_build=(
    "${packages_headless[@]}" libdrm-dev libseat-dev libinput-dev libudev-dev libevdev-dev
    xkb-data # read when the viewer starts
)
packages_test=("${libraries_test[@]}" ccache patch python3 python3-jsonschema parallel)
packages_package=(dpkg-dev file debootstrap lintian)
packages_bench=(libbenchmark-dev libegl-dev libopengl-dev libgl1-mesa-dri linux-perf valgrind binutils python3)
packages_clang=(clang-14 libclang-rt-14-dev)
packages_coverage=(llvm-14)
packages_counts=(valgrind binutils)
packages_lint=(clang-format-14 clang-tidy-14)
packages_arm=(g++-aarch64-linux-gnu qemu-user-static)
packages_guests=(qemu-system-x86 seabios ipxe-qemu busybox-static kmod python3)
packages_avx3=(bochs bochs-term bochsbios vgabios busybox-static kmod binutils python3) # bochs-term: without X

# Prints the packages of the purposes that are not installed, each once.
missing_packages() {
    local purpose package have wanted=()
    for purpose in "$@"; do
        local -n list=packages_$purpose
        wanted+=("${list[@]}")
    done
    # Its status is 1 when it does not know one of them, which would end this under `set -e`.
    have=$'\n'$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)$'\n'
    for package in "${wanted[@]}"; do
        [[ $have == *$'\n'"installed $package"$'\n'* ]] || echo "$package"
        have+="installed $package"$'\n' # named once
    done
}

as_root=()
[ "$(id -u)" = 0 ] || as_root=(sudo)

# apt_get ARGS...: quiet, without questions, as root; the output is shown only if it fails.
apt_get() {
    local log status=0
    log=$(mktemp)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
        -o Dpkg::Use-Pty=0 "$@" >"$log" 2>&1 || status=$?
    [ $status = 0 ] || tail -n 20 "$log" >&2
    rm -f "$log"
    return $status
}

# need PURPOSE...: everything is installed afterwards, or the reason stands on stderr and the status is 1.
# Uses no network when nothing is missing.
need() {
    local missing
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        command -v cmake >/dev/null && command -v ninja >/dev/null && return 0 # CMake names what it misses
        echo "scanout: this system has no apt-get: packages are installed by themselves on Debian 12 only." \
            "Install what these are called here, then try again: ${packages_build[*]}" >&2
        return 1
    fi
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} = 0 ] && return 0
    if [ ${#as_root[@]} != 0 ] && ! command -v sudo >/dev/null; then
        echo "scanout: packages are missing, and there is neither root nor sudo to install them." \
            "As root: apt-get install --no-install-recommends ${missing[*]}" >&2
        return 1
    fi
    echo "scanout: installing ${#missing[@]} packages by ${as_root[*]:+sudo }apt-get: ${missing[*]}" >&2
    if compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null &&
        apt_get install --no-install-recommends "${missing[@]}" 2>/dev/null; then
        return 0
    fi
    # No package lists yet, or too old ones.
    if ! apt_get update || ! apt_get install --no-install-recommends "${missing[@]}"; then
        echo "scanout: apt-get could not install ${missing[*]} (see above)" >&2
        return 1
    fi
}
