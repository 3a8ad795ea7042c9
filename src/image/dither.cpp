#include "image/dither.h"

#include "techniques.h"

namespace scanout::image {

#define SCANOUT_DECLARE(name) extern const Dither name;
namespace dither {
SCANOUT_DITHER(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const Dither* const> dithers() {
#define SCANOUT_ROW(name) &dither::name,
    static constexpr auto kAll = std::to_array<const Dither*>({SCANOUT_DITHER(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const Dither* find_dither(std::string_view name) {
    for (const Dither* found : dithers())
        if (found->card.name == name) return found;
    return nullptr;
}

} // namespace scanout::image
