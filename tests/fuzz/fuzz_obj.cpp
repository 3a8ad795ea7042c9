// Any bytes as an OBJ file.
#include "io/obj/obj.h"
#include "mesh_checks.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    Warnings warnings;
    auto obj = io::read_obj({reinterpret_cast<const char*>(data), size}, "x.obj", warnings);
    fuzz::check_lines(warnings);
    if (!obj) return 0;
    const auto names = static_cast<std::int32_t>(obj->materials.size());
    for (const std::int32_t material : obj->polygons.face_material)
        CHECK_LT(material, names);
    fuzz::check_polygons(obj->polygons);
    fuzz::check_built(std::move(obj->polygons));
    return 0;
}
