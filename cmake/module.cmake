# One folder under src/ = one module = one target on one floor of the house (src/README.md).

# The one interface target that carries language, warnings, floating-point policy and sanitizers.
add_library(scanout_flags INTERFACE)
target_compile_features(scanout_flags INTERFACE cxx_std_20)
# Same bits everywhere: a*b+c is never fused, and nothing reorders floating-point arithmetic.
target_compile_options(scanout_flags INTERFACE -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 drops the rounding of (double)(float)x where it vectorises straight-line code.
  target_compile_options(scanout_flags INTERFACE -fno-tree-slp-vectorize)
  # Of the time for kernels on plain lanes 40 % went into following memory through inlined arrays.
  target_compile_options(scanout_flags INTERFACE --param=sccvn-max-alias-queries-per-access=50)
endif()
target_compile_options(scanout_flags INTERFACE -Wall -Wextra -Wpedantic
                       $<$<NOT:$<BOOL:$<TARGET_PROPERTY:SCANOUT_MAY_SHADOW>>>:-Wshadow>)
# Highway holds its lanes in plain C++, EMU128, for broken on g++ before 12.3 and would fall back to
# one lane; the hash tests show that it is not.
target_compile_definitions(scanout_flags INTERFACE HWY_BROKEN_EMU128=0)
# EMU128 stands in every build, also where the machine always has better (64-bit Arm): the same bits are
# compared on it. Arm's scalable vectors have no size, so no lane type can hold one (simd/lanes-inl.h). SSE4 draws
# in 0.95 of the time of SSSE3, which has as many lanes and stands for both: a fifth of all kernels less.
# Sanitizers instrument every operation on plain lanes: a kernel took 260 s to compile for EMU128 and 2 s for
# AVX2. Where the machine has AVX2, sanitized builds hold that target alone; the other stages run the rest.
set(without_targets "HWY_SSE4|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128")
set(attainable HWY_COMPILE_ALL_ATTAINABLE)
if(SCANOUT_SANITIZE OR SCANOUT_FEW_TARGETS)
  string(APPEND without_targets "|HWY_SSSE3|HWY_AVX3")
endif()
if(SCANOUT_SANITIZE AND EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo cpu_with_avx2 REGEX "^flags.* fma .* avx2 .*bmi2" LIMIT_COUNT 1)
  if(cpu_with_avx2)
    string(APPEND without_targets "|HWY_EMU128")
    set(attainable)
    target_compile_options(scanout_flags INTERFACE -march=x86-64-v3 -maes -mpclmul) # Highway's AVX2 as baseline
  endif()
endif()
target_compile_definitions(scanout_flags INTERFACE ${attainable} "HWY_DISABLED_TARGETS=(${without_targets})")
if(SCANOUT_SANITIZE)
  target_compile_definitions(scanout_flags INTERFACE SCANOUT_SANITIZED)
  target_compile_options(scanout_flags INTERFACE -fsanitize=${SCANOUT_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(scanout_flags INTERFACE -fsanitize=${SCANOUT_SANITIZE})
endif()

# scanout_module(<name> [DIR <path>] [NO_AXES] [FOLDERS <folder>...] [CHOSEN <folder>] [DEPENDS <module>...] [LIBS <target>...]
#                [OWN_LIBS <target>...])
# Sources are every .cpp in the folder and in the named folders in it; where none is named, in all: those of axes. With
# NO_AXES in none. CHOSEN is the one of several folders that this build takes. OWN_LIBS are not included by headers that
# other modules include, so those compile the same where they are not there. A module may depend only on modules declared
# before it: an upward edge stops the configuration.
#
# Half of the time for a file that is no kernel went into reading headers: those of libraries that most files include
# are compiled once, from module math up, whose libraries they are. Files include what they use nevertheless:
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds, too.
set(SCANOUT_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <functional> <memory> <optional> <span> <string>
    <string_view> <utility> <vector> <fmt/format.h> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <tl/expected.hpp>)
function(scanout_module name)
  cmake_parse_arguments(A "NO_AXES" "DIR;CHOSEN" "FOLDERS;DEPENDS;LIBS;OWN_LIBS" ${ARGN})
  if(NOT A_DIR)
    set(A_DIR src/${name})
  endif()
  set(patterns ${PROJECT_SOURCE_DIR}/${A_DIR}/*.cpp)
  set(chosen)
  if(A_CHOSEN)
    file(GLOB chosen CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${A_DIR}/${A_CHOSEN}/*.cpp)
  endif()
  if(A_FOLDERS)
    list(TRANSFORM A_FOLDERS REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/${A_DIR}/\\1/*.cpp" OUTPUT_VARIABLE folders)
    list(APPEND patterns ${folders})
  elseif(NOT A_NO_AXES)
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/${A_DIR}/*/*.cpp)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  if(sources)
    add_library(scanout_${name} STATIC ${sources} ${chosen}) # units of the others do not depend on the choice
    scanout_unity(scanout_${name} 12 ${sources})
    set(scope PUBLIC)
  else()
    add_library(scanout_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  if(name STREQUAL "math")
    target_precompile_headers(scanout_math PRIVATE ${SCANOUT_COMMON_HEADERS})
  elseif(sources AND "math" IN_LIST A_DEPENDS)
    target_precompile_headers(scanout_${name} REUSE_FROM scanout_math)
  endif()
  target_include_directories(scanout_${name} ${scope} ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(scanout_${name} ${scope} scanout_flags ${A_LIBS})
  if(A_OWN_LIBS)
    target_link_libraries(scanout_${name} PRIVATE ${A_OWN_LIBS})
  endif()
  foreach(dependency IN LISTS A_DEPENDS)
    if(NOT TARGET scanout_${dependency})
      message(FATAL_ERROR "module ${name} may not depend on ${dependency}: it is not on a floor below "
                          "(modules are declared from the ground up in CMakeLists.txt)")
    endif()
    target_link_libraries(scanout_${name} ${scope} scanout_${dependency})
  endforeach()
  list(JOIN A_DEPENDS "," depends)
  set_property(GLOBAL APPEND PROPERTY SCANOUT_MODULES "${name}:${A_DIR}:${depends}")
endfunction()
