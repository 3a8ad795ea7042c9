// Any bytes as an STL file.
#include "io/stl/stl.h"
#include "mesh_checks.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    Warnings warnings;
    auto stl =
        io::read_stl({reinterpret_cast<const char*>(data), size}, "x.stl", warnings, nullptr);
    fuzz::check_lines(warnings);
    if (!stl) return 0;
    CHECK_EQ(stl->facets, stl->polygons.faces());
    fuzz::check_polygons(stl->polygons);
    fuzz::check_built(std::move(stl->polygons));
    return 0;
}
