#include "frame/plan/bytes.h"

#include "frame/facts/map_facts.h"

#include <vector>

namespace scanout::frame {
namespace {

// Texture files that triangles show through one of the maps; each counts once.
std::uint64_t texture_bytes(const scene::Scene& scene, scene::MaterialMap scene::Material::*map) {
    std::vector<bool> read(scene.textures.size(), false);
    std::uint64_t bytes = 0;
    for (const std::int32_t material : scene.mesh.material) {
        if (material < 0) continue;
        const std::int32_t texture =
            (scene.materials[static_cast<std::size_t>(material)].*map).texture();
        if (texture < 0 || read[static_cast<std::size_t>(texture)]) continue;
        read[static_cast<std::size_t>(texture)] = true;
        bytes += scene.textures[static_cast<std::size_t>(texture)].image.pixels().size_bytes();
    }
    return bytes;
}

} // namespace

EffectBytes bytes_by_effect(const scene::Scene& scene, const FramePlan& plan) {
    EffectBytes bytes;
    const auto add = [&](const char* effect, std::uint64_t held) {
        const Decision* row = plan.decision(effect);
        if (row != nullptr && row->on() && held > 0) bytes[effect] += held;
    };
    for (std::size_t i = 0; i < shade::kMaps; ++i)
        if (const auto effect = map_effect(static_cast<shade::Map>(i)); !effect.empty())
            add(std::string(effect).c_str(), texture_bytes(scene, shade::map_slots()[i].map));
    add("emission", texture_bytes(scene, &scene::Material::map_emission));
    for (const shade::MipUse& use : plan.mips)
        add("mipmaps",
            shade::mip_chain_bytes(scene.textures[static_cast<std::size_t>(use.texture)].image));
    if (plan.stencil != nullptr)
        add("stencil", StencilBuffer(plan.options.width, plan.options.height).bytes());
    if (plan.convolution != nullptr)
        add("convolution", plan.convolution->bytes(plan.shown_width, plan.shown_height));
    return bytes;
}

} // namespace scanout::frame
