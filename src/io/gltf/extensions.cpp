#include "io/gltf/extensions.h"

#include "io/text.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanout::io::gltf {
namespace {

constexpr std::array<std::string_view, 9> kDrawn = {"KHR_mesh_quantization",
                                                    "KHR_texture_transform",
                                                    "KHR_materials_unlit",
                                                    "KHR_materials_emissive_strength",
                                                    "KHR_materials_pbrSpecularGlossiness",
                                                    "EXT_mesh_gpu_instancing",
                                                    "EXT_meshopt_compression",
                                                    "KHR_meshopt_compression",
                                                    "KHR_draco_mesh_compression"};

// They change how a surface or its light looks, not its shape: shown without, even where required.
constexpr std::array<std::string_view, 4> kLooks = {"KHR_lights_", "KHR_materials_",
                                                    "KHR_techniques_", "EXT_lights_"};

bool is_drawn(std::string_view name) {
    return std::find(kDrawn.begin(), kDrawn.end(), name) != kDrawn.end();
}
bool is_of_looks(std::string_view name) {
    return std::any_of(kLooks.begin(), kLooks.end(),
                       [&](std::string_view prefix) { return name.starts_with(prefix); });
}

} // namespace

Result<> check_extensions(const Document& d, const std::string& path, Warnings& warnings) {
    for (const std::string& name : d.required)
        if (!is_drawn(name) && !is_of_looks(name))
            return fail(Exit::unreadable,
                        "{}: requires the extension '{}', which is not read: export it without",
                        path, shown(name));
    std::vector<std::string> ignored;
    for (const std::string& name : d.used)
        if (!is_drawn(name) && ignored.size() < 16) ignored.push_back(shown(name));
    std::sort(ignored.begin(), ignored.end());
    ignored.erase(std::unique(ignored.begin(), ignored.end()), ignored.end());
    if (!ignored.empty())
        warnings.add("glTF extensions",
                     fmt::format("{}: drawn without the extension{} {}", path,
                                 ignored.size() == 1 ? "" : "s", fmt::join(ignored, ", ")));
    return {};
}

} // namespace scanout::io::gltf
