// Any bytes as a PLY file.
#include "io/ply/ply.h"
#include "mesh_checks.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    Warnings warnings;
    auto file =
        io::read_ply({reinterpret_cast<const char*>(data), size}, "x.ply", warnings, nullptr);
    fuzz::check_lines(warnings);
    if (!file) return 0;
    fuzz::check_polygons(file->polygons);
    fuzz::check_built(std::move(file->polygons));
    return 0;
}
