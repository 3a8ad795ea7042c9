# Every library scanout uses, by its Debian package; `scripts/packages.sh` installs the same list.
find_package(Threads REQUIRED)
find_package(tl-expected CONFIG REQUIRED)   # libexpected-dev
find_package(fmt CONFIG REQUIRED)           # libfmt-dev
find_package(TBB 2021 CONFIG REQUIRED)      # libtbb-dev
find_package(glm CONFIG REQUIRED)           # libglm-dev
find_package(hwy CONFIG REQUIRED)           # libhwy-dev
find_package(PNG REQUIRED)                  # libpng-dev
find_package(ZLIB REQUIRED)                 # zlib1g-dev
find_package(JPEG REQUIRED)                 # libjpeg62-turbo-dev
find_package(PkgConfig REQUIRED)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)    # libxxhash-dev
pkg_check_modules(UTF8PROC REQUIRED IMPORTED_TARGET libutf8proc) # libutf8proc-dev
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)             # libstb-dev
find_package(simdjson CONFIG REQUIRED)      # libsimdjson-dev
find_package(meshoptimizer CONFIG REQUIRED) # libmeshoptimizer-dev
pkg_check_modules(DRACO REQUIRED IMPORTED_TARGET draco)          # libdraco-dev
if(SCANOUT_PROGRAM)
  find_package(CLI11 CONFIG REQUIRED)         # libcli11-dev
  find_package(nlohmann_json CONFIG REQUIRED) # nlohmann-json3-dev
  find_package(tomlplusplus 3 CONFIG REQUIRED) # libtomlplusplus-dev
  find_package(embree 3 CONFIG REQUIRED)      # libembree-dev
  pkg_check_modules(XKB REQUIRED IMPORTED_TARGET xkbcommon)     # libxkbcommon-dev
  if(SCANOUT_DISPLAYS)
    pkg_check_modules(DRM REQUIRED IMPORTED_TARGET libdrm)        # libdrm-dev
    pkg_check_modules(SEAT REQUIRED IMPORTED_TARGET libseat)      # libseat-dev
    pkg_check_modules(INPUT REQUIRED IMPORTED_TARGET libinput)    # libinput-dev
    pkg_check_modules(UDEV REQUIRED IMPORTED_TARGET libudev)      # libudev-dev
    pkg_check_modules(EVDEV REQUIRED IMPORTED_TARGET libevdev)    # libevdev-dev
  endif()
endif()
