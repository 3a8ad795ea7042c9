// Any bytes as a gzip file; what it unpacks to is read as an OBJ file.
#include "base/check.h"
#include "io/gzip.h"
#include "io/obj/obj.h"
#include "mesh_checks.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    constexpr std::uint64_t kMost = 1 << 16;
    const auto file = io::gunzip({reinterpret_cast<const char*>(data), size}, "x.obj.gz", kMost);
    if (!file) {
        CHECK(file.error().exit == Exit::unreadable && file.error().what.starts_with("x.obj.gz: "));
        return 0;
    }
    CHECK_LE(file->size(), kMost);
    Warnings warnings;
    auto obj = io::read_obj(file->text(), "x.obj", warnings);
    fuzz::check_lines(warnings);
    if (obj) fuzz::check_polygons(obj->polygons);
    return 0;
}
