# Several sources of a module make one unit of compilation. Most of the time for a kernel goes into reading Highway once
# for every SIMD target, most of the time for another file into reading headers: a unit reads them once. What differs:
# names of anonymous namespaces are those of a unit, so files of a module must not share them.
option(SCANOUT_UNITY "Compile several files of a module together; OFF: each alone, quicker after a change of one file" ON)

# scanout_unity(<target> <most> <source>...): kernels together with kernels, other files with others, at most so many of
# them in a unit.
function(scanout_unity target most)
  if(NOT SCANOUT_UNITY)
    return()
  endif()
  set(kernels)
  set(others)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} simd_file REGEX "^#define SIMD_FILE " LIMIT_COUNT 1)
    if(simd_file)
      list(APPEND kernels ${source})
    else()
      list(APPEND others ${source})
    endif()
  endforeach()
  scanout_unity_groups(kernels 8 ${kernels})
  scanout_unity_groups(files ${most} ${others})
  # SIMD_UNIT and SIMD_FILE: src/simd/for_each_target.h
  # clang warns of a local name that is a constant of another file of the unit, g++ does not.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set_target_properties(${target} PROPERTIES SCANOUT_MAY_SHADOW ON)
  endif()
  # A unit of kernels includes itself, under a compiler cache by its path from the build's folder.
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP
                        UNITY_BUILD_CODE_BEFORE_INCLUDE "#undef SIMD_FILE\n#define SIMD_UNIT __BASE_FILE__")
endfunction()

# scanout_unity_groups(<prefix> <most> <source>...): as few groups as hold at most so many each, of nearly the same size.
function(scanout_unity_groups prefix most)
  list(LENGTH ARGN sources)
  math(EXPR groups "(${sources} + ${most} - 1) / ${most}")
  set(index 0)
  foreach(source IN LISTS ARGN)
    math(EXPR group "${index} * ${groups} / ${sources}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${prefix}_${group})
    math(EXPR index "${index} + 1")
  endforeach()
endfunction()
