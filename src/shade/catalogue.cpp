// Every stage and filter by name: techniques.h expanded once. A name without a file is a link
// error.
#include "shade/sides.h"
#include "shade/stage.h"
#include "shade/transparency.h"
#include "techniques.h"

#include <array>

namespace scanout::shade {

#define SCANOUT_DECLARE(name) extern const Stage name;
namespace interpolate {
SCANOUT_INTERPOLATE(SCANOUT_DECLARE)
}
namespace mapping {
SCANOUT_MAPPING(SCANOUT_DECLARE)
}
namespace map {
SCANOUT_MAP(SCANOUT_DECLARE)
}
namespace light {
SCANOUT_LIGHT(SCANOUT_DECLARE)
}
namespace shadow {
SCANOUT_SHADOW(SCANOUT_DECLARE)
}
namespace reflection {
SCANOUT_REFLECTION(SCANOUT_DECLARE)
}
namespace shading {
SCANOUT_SHADING(SCANOUT_DECLARE)
}
namespace exposure {
SCANOUT_EXPOSURE(SCANOUT_DECLARE)
}
namespace tone {
SCANOUT_TONE(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const Filter name;
namespace texture {
SCANOUT_TEXTURE(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const Blend name;
namespace blend {
SCANOUT_BLEND(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const Transparency name;
namespace transparency {
SCANOUT_TRANSPARENCY(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const Source name;
namespace source {
SCANOUT_SOURCE(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const Wrapping name;
namespace wrap {
SCANOUT_WRAP(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const LitSides name;
namespace sides {
SCANOUT_SIDES(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const LitSides* const> lit_sides() {
#define SCANOUT_ROW(name) &sides::name,
    static constexpr auto kAll = std::to_array<const LitSides*>({SCANOUT_SIDES(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

std::span<const Stage* const> stages() {
    static constexpr auto kStages = std::to_array<const Stage*>({
#define SCANOUT_ROW(name) &interpolate::name,
        SCANOUT_INTERPOLATE(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &mapping::name,
            SCANOUT_MAPPING(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &map::name,
                SCANOUT_MAP(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &light::name,
                    SCANOUT_LIGHT(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &shadow::name,
                        SCANOUT_SHADOW(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &reflection::name,
                            SCANOUT_REFLECTION(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &shading::name,
                                SCANOUT_SHADING(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &exposure::name,
                                    SCANOUT_EXPOSURE(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &tone::name,
                                        SCANOUT_TONE(SCANOUT_ROW)
#undef SCANOUT_ROW
    });
    return kStages;
}

std::span<const Filter* const> filters() {
#define SCANOUT_ROW(name) &texture::name,
    static constexpr auto kFilters = std::to_array<const Filter*>({SCANOUT_TEXTURE(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kFilters;
}

std::span<const Blend* const> blends() {
#define SCANOUT_ROW(name) &blend::name,
    static constexpr auto kAll = std::to_array<const Blend*>({SCANOUT_BLEND(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const Blend* find_blend(std::string_view name) {
    for (const Blend* blend : blends())
        if (blend->card.name == name) return blend;
    return nullptr;
}

std::span<const Transparency* const> transparencies() {
#define SCANOUT_ROW(name) &transparency::name,
    static constexpr auto kAll =
        std::to_array<const Transparency*>({SCANOUT_TRANSPARENCY(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

std::span<const Source* const> sources() {
#define SCANOUT_ROW(name) &source::name,
    static constexpr auto kSources = std::to_array<const Source*>({SCANOUT_SOURCE(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kSources;
}

std::span<const Wrapping* const> wrappings() {
#define SCANOUT_ROW(name) &wrap::name,
    static constexpr auto kWrappings = std::to_array<const Wrapping*>({SCANOUT_WRAP(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kWrappings;
}

const std::array<MapSlot, kMaps>& map_slots() {
    static constexpr std::array<MapSlot, kMaps> kSlots = {
        MapSlot{&scene::Material::map_diffuse, TexelKind::colour},
        MapSlot{&scene::Material::map_opacity, TexelKind::data},
        MapSlot{&scene::Material::map_normal, TexelKind::data},
        MapSlot{&scene::Material::map_bump, TexelKind::data},
        MapSlot{&scene::Material::map_specular, TexelKind::data},
        MapSlot{&scene::Material::map_shininess, TexelKind::data},
        MapSlot{&scene::Material::map_roughness, TexelKind::data},
        MapSlot{&scene::Material::map_metalness, TexelKind::data},
        MapSlot{&scene::Material::map_emission, TexelKind::colour}};
    return kSlots;
}

const Stage* find_stage(std::string_view axis, std::string_view name) {
    for (const Stage* stage : stages())
        if (stage->card.axis == axis && stage->card.name == name) return stage;
    return nullptr;
}

const Filter* find_filter(std::string_view name) {
    for (const Filter* filter : filters())
        if (filter->card.name == name) return filter;
    return nullptr;
}

const Transparency* find_transparency(std::string_view name) {
    for (const Transparency* transparency : transparencies())
        if (transparency->card.name == name) return transparency;
    return nullptr;
}

const Wrapping* find_wrapping(std::string_view name) {
    for (const Wrapping* wrapping : wrappings())
        if (wrapping->card.name == name) return wrapping;
    return nullptr;
}

const Source* find_source(std::string_view name) {
    for (const Source* source : sources())
        if (source->card.name == name) return source;
    return nullptr;
}

} // namespace scanout::shade
