# shellcheck shell=bash disable=SC2034,SC2154  # sourced by ./test, which sets root and counts
# The stages of ./test, in the order of CI: about an hour on two cores, all builds included.
# A stage runs with `set -e` in a subshell at the root and adds lines "PASSED FAILED SKIPPED" to $counts.

ci_stages=(unit golden cli counts effects bits asan tsan guests fuzz)
# By name only.
long_stages=(lint analyze faults arm avx3 walk growth assets coverage fuzz_long package)
declare -A stage_needs=(
    [unit]="build test" [golden]="build test" [cli]="build test" [effects]="build test counts" [counts]="build test counts" [bits]="build test clang"
    [asan]="build test clang" [tsan]="build test clang" [guests]="build guests" [fuzz]="build test clang"
    [lint]="build test lint" [analyze]="build test lint" [faults]="build test" [arm]="build test arm"
    [avx3]="build test avx3" [walk]="build test" [growth]="build test"
    [assets]="build test clang" [package]="build package"
    [coverage]="build test clang coverage" [fuzz_long]="build test clang coverage"
)

# Property tests (rapidcheck) draw the same cases each time, so that a commit's outcome is its own. `./test walk` draws
# new ones.
export RC_PARAMS=${RC_PARAMS-seed=1}

# What one stage compiled another does not compile again, above all the release of ./run, which differs in no more than
# -Werror. Only this script uses the cache, so nothing in it was compiled without. The folder is left out of what a
# command is told apart by: precompiled headers lie in it.
use_cache() {
    command -v ccache >/dev/null || return 0
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=$root/build/ccache
    export CCACHE_BASEDIR=$root/build CCACHE_IGNOREOPTIONS=-Werror CCACHE_SLOPPINESS=pch_defines,time_macros
}

# configure FOLDER PRESET [ARGS...]: configures build/FOLDER, unless it is configured so already.
configure() {
    use_cache
    local folder=build/$1 wanted="$root ${*:2}"
    if [ "$(cat "$folder/configured" 2>/dev/null)" != "$wanted" ] || [ ! -f "$folder/build.ninja" ]; then
        rm -rf "$folder"
        mkdir -p "$folder"
        cmake --preset "$2" -B "$folder" -DSCANOUT_TESTS=ON -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "${@:3}" \
            >"$folder/configure.log" 2>&1 || {
            cat "$folder/configure.log"
            return 1
        }
        echo "$wanted" >"$folder/configured"
    fi
}

# build FOLDER [TARGETS...]
build() {
    local quiet=--quiet
    [ -t 1 ] && quiet=
    ninja $quiet -C "build/$1" "${@:2}"
}

# run_ctest FOLDER ARGS...: prints what fails, counts the cases. No tests at all is a failure.
run_ctest() {
    local status=0
    rm -f "build/$1/junit.xml"
    ctest --test-dir "build/$1" --no-tests=error --output-on-failure -j "$(nproc)" \
        --output-junit "$root/build/$1/junit.xml" "${@:2}" >"build/$1/ctest.log" 2>&1 || status=$?
    ! grep -m 1 '^RegularExpression' "build/$1/ctest.log" || status=1 # ctest goes on without it
    grep -vE '^ *Start +[0-9]+:|  Passed +[0-9.]+ sec$|^Internal ctest|^Test project|^$' "build/$1/ctest.log" || true
    python3 scripts/ctest.py "build/$1/junit.xml" >>"$counts"
    return $status
}

# check COMMAND...: counts as one case; status 77 says that it was skipped.
check() {
    local status=0
    "$@" || status=$?
    case $status in
    0) echo "1 0 0" ;;
    77) echo "0 0 1" ;;
    *) echo "0 1 0" ;;
    esac >>"$counts"
}

stage_unit() {
    configure test release
    build test
    run_ctest test -L unit
}

stage_golden() {
    configure test release
    build test
    run_ctest test -L golden
}

# The program from outside: README's commands, bad files, silhouettes, and ./run itself.
stage_cli() {
    configure test release
    build test
    run_ctest test -L cli
    check check_run
    check check_headless
}

# The instructions of six fixed frames against those kept in bench/counts, in the release that ./run builds.
stage_counts() {
    use_cache
    "$root/run" list targets >/dev/null
    check python3 -B bench/counts.py build/release
}

# Only the effects that a scene calls for: instructions by callgrind, so not beside other work of this script.
stage_effects() {
    configure test release
    build test
    run_ctest test -L effects
}

# The program without displays: it draws the same, needs none of their libraries, and says what it lacks.
check_headless() {
    use_cache
    cmake --preset release -B build/headless -DSCANOUT_DISPLAYS=OFF >build/headless.log 2>&1 || {
        cat build/headless.log
        return 1
    }
    ninja --quiet -C build/headless scanout || return 1
    local program status=0
    if ldd build/headless/scanout | grep -E 'libdrm|libinput|libseat|libudev|libevdev'; then return 1; fi
    for program in test headless; do
        "build/$program/scanout" render models/spot/spot.obj --hash --json=build/headless/$program.json >build/headless/$program.hash ||
            return 1
    done
    cmp build/headless/test.hash build/headless/headless.hash || return 1
    build/headless/scanout view models/spot/spot.obj 2>build/headless/view.log || status=$?
    [ $status = 5 ] && grep -q SCANOUT_DISPLAYS build/headless/view.log
}

# ./run without arguments, in a folder of its own: where there is no display it must leave a picture.
check_run() {
    if compgen -G '/dev/dri/card*' >/dev/null || [ -e /dev/fb0 ]; then
        return 77 # it would take this machine's screen
    fi
    local folder
    folder=$(mktemp -d)
    local status=0
    (cd "$folder" && "$root/run") &&
        "$root/run" render "$root/models/spot/spot.obj" --camera 150,20 -o "$folder/again.png" &&
        "$root/run" compare "$folder/scanout.png" "$folder/again.png" || status=1
    rm -rf "$folder"
    return $status
}

# run_modules FOLDER MODULE...: builds and runs the tests of these modules.
run_modules() {
    local folder=$1 names
    shift
    build "$folder" "${@/#/test_}"
    names=$(printf '%s|' "$@")
    run_ctest "$folder" -R "^(${names%|})\\." ${without:+-E "$without"}
}

# The same bits from the other compiler: every hash and picture, on every SIMD target. (The other modules' cases run
# from clang++ with the sanitizers.)
stage_bits() {
    configure bits release -DCMAKE_CXX_COMPILER=clang++-14
    run_modules bits math simd golden
    configure test release
    build test scanout
    check nothing_fused test
    check nothing_fused bits
    check python3 -B tests/house/weak_functions.py build/bits/libscanout_*.a
}

# nothing_fused FOLDER: neither compiler made a*b+c one operation in code that decides a pixel.
nothing_fused() {
    local module found=0 kernels=0
    for module in base math simd image geom scene io raster shade frame; do
        objdump -d --no-show-raw-insn "build/$1/libscanout_$module.a" >"build/$1/$module.asm"
        if grep -E -m 1 '\bvfn?m(add|sub)' "build/$1/$module.asm"; then
            echo "libscanout_$module.a has fused operations" >&2
            found=1
        fi
        kernels=$((kernels + $(grep -c '\bvmulp[sd]' "build/$1/$module.asm" || true)))
        rm "build/$1/$module.asm"
    done
    [ $found = 0 ] && [ $kernels -gt 100 ] # it does see vector code
}

# With sanitizers: clang++ at -O1, which builds in a third of g++'s time at -O2.
sanitized=(-DCMAKE_CXX_COMPILER=clang++-14 "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -gline-tables-only")

# Cases that judge numbers by the million: instrumented, their oracles alone take a quarter of an hour. The other cases,
# the hashes and the pictures go through the same code. The last lines judge milliseconds and megabytes of the program.
numbers=(
    raster.{ExactCoverage,Guard.{A,Tri,Its,TheSize},Depth,P1/,P2/,Row17/,ClippedTriangle.Covers,Clip.TheTwoSides}
    raster.{Coverage.ATurned,Coverage.AFan,Homogeneous,P9,P10,Row50,OcclusionHistory,LineOnTriangle.IsSeen}
    raster.{ClippedTriangle.HasDepth,Segment.DoesNot,Segment.CoversOne,ClusterCull.ChangesNo}
    geom.{Build.Progress,Build.TheNumber,JoinTable.Numbers,SpatialOrder.SaysHowFar,Section.PlanesThrough}
    shade.{ShadingSetup.HasTheBits,Gather.ShadesATriangle} golden.Hashes.AreTheSameForEveryTile
    frame.{'Shadow\..*RaysSay',AntiAliasing,Metamorphic.Scaling,Minification,ItemsShaded,P4/,P11/,All/BlendingModes}
    frame.{Transparency.TheLength,Transparency.AMaterial,Outline.IsWhere,TwoSided.Decided,ShadowEdgeOn,DisjointShadows}
    frame.{FrontFaceShadows.OfAClosed,IgnoredOptions.WhatIs,Blending.OfTwoHundred,OcclusionHistory}
    app.{AccuracySession.WhileItMovesFewer,Program.FrontierGoesOnWithoutAReference,Session.TenSeconds}
    app.{RungSession.AFrontierIsMeasured,Budget.IsMeasuredAnew,Budget.IsTried,Session.AReplayShowsThePlan}
    app.{Steady.AMillion,FrontierSentences.NameTheDearest,Reference.IsWhatTheRenderer,HelpSheet.IsWholly}
)
# One expression without parentheses: ctest takes nine at most, and without a word more than those as no expression.
without_numbers=$(printf '|^%s' "${numbers[@]}")
without_numbers=${without_numbers#|}

# AddressSanitizer and UndefinedBehaviorSanitizer; the fuzz targets belong to the same build.
configure_asan() { configure asan asan "${sanitized[@]}" -DSCANOUT_FUZZ=ON; }

# What reads files, holds pixels or runs threads, and the program itself: on every bad file, and the viewer on a recording.
stage_asan() {
    configure_asan
    export ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1
    export UBSAN_OPTIONS=print_stacktrace=1
    without=$without_numbers run_modules asan base image geom scene io raster shade frame golden port platform app
    build asan scanout
    run_ctest asan -L sanitized
}

# What runs threads: the render core on each of its scenes (golden), the viewer, and it on a recording.
stage_tsan() {
    configure tsan tsan "${sanitized[@]}"
    export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$root/tests/tsan.supp
    without=$without_numbers run_modules tsan base golden app
    build tsan scanout
    run_ctest tsan -R '^cli\.replay$'
}

readers=(obj mtl stl ply off gltf gzip image)

# Each reader 25 seconds, one on each core; a crash, a hang or 1 GB is a failure.
stage_fuzz() {
    configure_asan
    build asan "${readers[@]/#/fuzz_}"
    local name
    for name in "${readers[@]}"; do
        while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n || true; done
        check fuzz asan "$name" -max_total_time=25 &
    done
    wait
}

# fuzz FOLDER READER LIMIT...: prints how many inputs it was given, and of how many kinds.
fuzz() {
    local folder=build/$1 name=$2 status=0
    local log=$folder/fuzz-$name.log corpus=$folder/corpus-$name
    mkdir -p "$corpus"
    "$folder/tests/fuzz/fuzz_$name" "${@:3}" -rss_limit_mb=1024 -timeout=10 -print_final_stats=1 \
        -artifact_prefix="$folder/fuzz-$name-" "$corpus" "tests/fuzz/seeds/$name" >"$log" 2>&1 || status=$?
    if [ $status = 0 ]; then
        echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs," \
            "$(grep -oE 'cov: [0-9]+' "$log" | tail -n 1 | tr -d 'cov: ') edges"
    else
        tail -n 60 "$log"
    fi
    [ $status = 0 ] # libFuzzer ends with 77 where it finds something, which is no skipped test
}

configure_coverage() { configure coverage asan "${sanitized[@]}" -DSCANOUT_FUZZ=ON -DSCANOUT_COVERAGE=ON; }

# What the readers' tests and 20 000 inputs made of the seeds go through: 95 % of the lines of src/io and 90 % of its
# branches. (The seeds alone reach 89.3 %.)
stage_coverage() {
    configure_coverage
    build coverage "${readers[@]/#/fuzz_}" test_io
    rm -rf build/coverage/profiles
    export LLVM_PROFILE_FILE=$root/build/coverage/profiles/%4m.profraw
    run_modules coverage io
    local name
    for name in "${readers[@]}"; do
        check fuzz coverage "$name" -runs=20000 -seed=1
    done
    check python3 -B scripts/coverage.py build/coverage --lines
}

# Each reader $FUZZ_RUNS inputs, or 10^7: hours. The corpus stays, and the next run goes on from it.
stage_fuzz_long() {
    configure_coverage
    build coverage "${readers[@]/#/fuzz_}" test_io
    export LLVM_PROFILE_FILE=$root/build/coverage/profiles/%4m.profraw
    local name
    for name in "${readers[@]}"; do
        while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n || true; done
        check fuzz coverage "$name" -runs="${FUZZ_RUNS:-10000000}" &
    done
    wait
    check python3 -B scripts/coverage.py build/coverage
}

stage_guests() {
    configure test release
    build test scanout vm_helper
    local status=0
    python3 -B tests/vm/guests.py build/test/scanout build/test/guests | tee build/test/guests.log || status=$?
    sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2 0/p' build/test/guests.log >>"$counts"
    return $status
}

# Each fault of tests/faults put into a copy of the sources: the tests that it names must fail.
stage_faults() {
    use_cache
    local status=0
    mkdir -p build/faults
    python3 -B tests/faults/faults.py build/faults | tee build/faults/faults.log || status=$?
    sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2 0/p' build/faults/faults.log >>"$counts"
    return $status
}

# The render core on 64-bit Arm, under QEMU: the same hashes and pictures, on NEON and on plain lanes.
stage_arm() {
    tests/arm/sysroot.sh build/arm-sysroot
    configure arm release -DSCANOUT_PROGRAM=OFF -DCMAKE_TOOLCHAIN_FILE=cmake/arm64.cmake \
        "-DSCANOUT_SYSROOT=$root/build/arm-sysroot"
    run_modules arm math simd golden
}

# The hashes and the lanes on AVX3; in an emulated guest where the CPU has no AVX-512.
stage_avx3() {
    configure test release
    build test test_golden test_simd test_shade
    check python3 -B tests/avx3/avx3.py build/test build/test/avx3
}

# The property tests, each of thousands of new cases; then random frames for $WALK_SECONDS, or 20 minutes. Both from the
# seed $WALK_SEED, or a new one, which is printed.
stage_walk() {
    local folder folders seed=${WALK_SEED:-$RANDOM$RANDOM}
    mapfile -t folders < <(grep -rl --include='*_test.cpp' RC_GTEST_PROP tests | cut -d / -f 2 | sort -u)
    configure test release
    build test walk "${folders[@]/#/test_}"
    echo "property tests: again by WALK_SEED=$seed"
    for folder in "${folders[@]}"; do
        while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n || true; done
        check properties "$folder" "$seed" &
    done
    wait
    python3 -B tests/effects/make_models.py build/test/walk
    check build/test/tests/walk "${WALK_SECONDS:-1200}s" "${WALK_SEED:-0}" build/test/walk models
}

# properties FOLDER SEED: its property tests, for ten minutes at most.
properties() {
    local log=build/test/properties-$1.log names status=0
    names=$(grep -rhoE --include='*_test.cpp' 'RC_GTEST_PROP\(\w+, \w+' "tests/$1" | sed 's/.*(//; s/, /./' | paste -sd :)
    RC_PARAMS="seed=$2 max_success=5000" timeout 600 "build/test/tests/test_$1" --gtest_filter="$names" >"$log" 2>&1 ||
        status=$?
    if [ $status = 0 ]; then echo "$1: $(tail -n 1 "$log")"; else tail -n 60 "$log"; fi
    [ $status != 124 ] || echo "$1: not finished after ten minutes"
    return $status
}

# Time and memory of inputs that make programs quadratic, at n, 2 n and 4 n.
stage_growth() {
    configure test release
    build test scanout
    check python3 -B tests/growth/growth.py build/test/scanout
}

# Every file of the asset set through render, doctor and explain: of a release within its limits, then of a build with
# sanitizers in a minute each.
stage_assets() {
    local assets=$root/../shared/assets
    configure test release
    build test scanout
    check python3 -B tests/assets/outcomes.py build/test/scanout "$assets"
    check python3 -B tests/assets/gltf.py build/test/scanout "$assets"
    [ -d "$assets" ] || return 0
    configure_asan
    build asan scanout
    check python3 -B tests/assets/outcomes.py build/asan/scanout "$assets" --seconds 60 --megabytes 0
}

# The Debian package: lintian, and a chroot with nothing but Debian's base; root alone can make one.
stage_package() {
    check tests/package/package.sh "$root"
}

# Format of every file; clang-tidy over the program's own sources, without its analyzer.
stage_lint() {
    configure lint release -DSCANOUT_UNITY=OFF
    check check_format
    check tidy '-clang-analyzer-*'
}

# clang-tidy's analyzer: as long as all other checks together.
stage_analyze() {
    configure lint release -DSCANOUT_UNITY=OFF
    check tidy '-*,clang-analyzer-*'
}

# tidy CHECKS: with these on top of .clang-tidy, all cores.
tidy() {
    local log=build/lint/tidy.log status=0
    run-clang-tidy-14 -quiet -p build/lint -j "$(nproc)" -checks="$1" '/(src|platform)/' >"$log" 2>&1 || status=$?
    grep -vE '^clang-tidy-14 |warnings? generated|^Suppressed |^Use -header-filter|^$' "$log" || true
    return $status
}

check_format() {
    find src platform tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 |
        xargs -0 -r clang-format-14 --dry-run --Werror
}
