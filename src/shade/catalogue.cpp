// Every stage by name: techniques.h expanded once. A name without a file is a link error.
#include "shade/stage.h"
#include "techniques.h"

#include <array>

namespace scanout::shade {

#define SCANOUT_DECLARE(name) extern const Stage name;
namespace interpolate {
SCANOUT_INTERPOLATE(SCANOUT_DECLARE)
}
namespace texture {
SCANOUT_TEXTURE(SCANOUT_DECLARE)
}
namespace reflection {
SCANOUT_REFLECTION(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const Stage* const> catalogue() {
#define SCANOUT_ROW(name) &interpolate::name,
    static constexpr auto kStages =
        std::to_array<const Stage*>({SCANOUT_INTERPOLATE(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &texture::name,
                                         SCANOUT_TEXTURE(SCANOUT_ROW)
#undef SCANOUT_ROW
#define SCANOUT_ROW(name) &reflection::name,
                                             SCANOUT_REFLECTION(SCANOUT_ROW)
#undef SCANOUT_ROW
        });
    return kStages;
}

const Stage* find(std::string_view axis, std::string_view name) {
    for (const Stage* stage : catalogue())
        if (stage->card.axis == axis && stage->card.name == name) return stage;
    return nullptr;
}

} // namespace scanout::shade
