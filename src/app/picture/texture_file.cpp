#include "app/picture/texture_file.h"

#include "image/codec.h"
#include "image/image.h"
#include "io/hidden_colours.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {

Result<void> put_texture(const std::string& picture, scene::Scene& scene,
                         std::vector<std::string>& warnings) {
    TRY(image::Image read, image::load(picture));
    io::paint_clear_alpha(read);
    io::fill_hidden_colours(read);
    const auto number = static_cast<std::int32_t>(scene.textures.size());
    std::size_t changed = 0;
    const auto put_on = [&](scene::Material& material) {
        if (material.map_diffuse.given()) return;
        scene::TextureMap& map = material.map_diffuse.edit();
        map.path = picture;
        map.texture = number;
        ++changed;
    };
    const std::vector<std::int32_t>& used = scene.mesh.material;
    if (std::find(used.begin(), used.end(), -1) != used.end()) {
        put_on(scene.unnamed);
        scene.unnamed.diffuse = Vec3(1);
    }
    std::for_each(scene.materials.begin(), scene.materials.end(), put_on);
    scene.counts.bytes += read.pixels().size_bytes();
    scene.textures.push_back({picture, std::move(read)});
    if (changed == 0)
        warnings.push_back(fmt::format(
            "--texture-file {} changes nothing: every material names a texture of its own",
            picture));
    else if (scene.mesh.uv.empty())
        warnings.push_back(
            fmt::format("--texture-file {}: the model has no texture coordinates; --mapping makes "
                        "some (`scanout list techniques`)",
                        picture));
    return {};
}

} // namespace scanout::app
