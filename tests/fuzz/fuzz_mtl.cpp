// Any bytes as an MTL file.
#include "base/check.h"
#include "io/obj/mtl.h"
#include "mesh_checks.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

bool is_finite(const scanout::Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    Warnings warnings;
    const auto materials =
        io::read_mtl({reinterpret_cast<const char*>(data), size}, "x.mtl", warnings);
    fuzz::check_lines(warnings);
    for (const io::MtlMaterial& m : materials) {
        CHECK(m.line > 0);
        CHECK(is_finite(m.material.diffuse) && is_finite(m.material.specular) &&
              is_finite(m.material.emission));
        CHECK(m.material.opacity >= 0 && m.material.opacity <= 1);
        CHECK(std::isfinite(m.material.shininess) && m.material.shininess >= 0);
        CHECK(is_finite(m.material.map_diffuse->offset) &&
              is_finite(m.material.map_diffuse->scale));
    }
    return 0;
}
