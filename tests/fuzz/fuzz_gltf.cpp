// Any bytes as a glTF or GLB file; it names no file that is there.
#include "io/gltf/gltf.h"
#include "mesh_checks.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace scanout;
    Warnings warnings;
    io::Reading how;
    how.memory_bytes = 64 << 20;
    how.texture_bytes = 4 << 20;
    auto file = io::read_gltf({reinterpret_cast<const char*>(data), size}, "/no/such/folder/x.glb",
                              warnings, nullptr, how);
    fuzz::check_lines(warnings);
    if (!file) return 0;
    for (const scene::Material& material : file->materials)
        for (const scene::NamedMap& row : scene::kTextureMaps)
            CHECK_LT((material.*row.map).texture(),
                     static_cast<std::int32_t>(file->textures.size()));
    for (const std::int32_t material : file->polygons.face_material)
        CHECK_LT(material, static_cast<std::int32_t>(file->materials.size()));
    fuzz::check_polygons(file->polygons);
    fuzz::check_built(std::move(file->polygons));
    return 0;
}
