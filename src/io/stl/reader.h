// The part that both STL readers share; stl.cpp tells the formats apart and reads the binary one.
#pragma once

#include "geom/join_table.h"
#include "io/stl/stl.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace scanout::io {

using StlTriangle = std::array<DVec3, 3>;

// Gathers facets. Vertices on the same place become one, so that normals can be shared.
class StlCollector {
public:
    // `expected` facets: a guess.
    StlCollector(Jobs& jobs, const std::string& path, Warnings& warnings, std::size_t expected);

    // Fastest with many triangles at a time: all cores work on them.
    // `materials`: one a triangle, or empty where none has one.
    void add(std::span<const StlTriangle> triangles, std::span<const std::int32_t> materials = {});

    // `line`: the finished message, with its place.
    void skip(std::string line);

    Result<StlResult> finish();

private:
    Jobs& jobs_;
    const std::string& path_;
    Warnings& warnings_;
    geom::JoinTable positions_;
    StlResult result_;
    std::string first_fault_;
};

// Calls `progress` with the share that is done; an error when that cancels.
Result<> report(const std::function<bool(double)>& progress, std::size_t done, std::size_t size,
                const std::string& path);

// stl_ascii.cpp
bool begins_like_ascii_stl(std::string_view file);
Result<StlResult> read_ascii_stl(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how);

} // namespace scanout::io
