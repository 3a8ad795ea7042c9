#include "shade/output.h"

#include "techniques.h"

#include <array>

namespace scanout::shade {

#define SCANOUT_DECLARE(name) extern const Encoding name;
namespace encode {
SCANOUT_ENCODE(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const BlendSpace name;
namespace blend_space {
SCANOUT_BLEND_SPACE(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const Encoding* const> encodings() {
#define SCANOUT_ROW(name) &encode::name,
    static constexpr auto kEncodings =
        std::to_array<const Encoding*>({SCANOUT_ENCODE(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kEncodings;
}

std::span<const BlendSpace* const> blend_spaces() {
#define SCANOUT_ROW(name) &blend_space::name,
    static constexpr auto kSpaces =
        std::to_array<const BlendSpace*>({SCANOUT_BLEND_SPACE(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kSpaces;
}

const Encoding* find_encoding(std::string_view name) {
    for (const Encoding* encoding : encodings())
        if (encoding->card.name == name) return encoding;
    return nullptr;
}

const BlendSpace* find_blend_space(std::string_view name) {
    for (const BlendSpace* space : blend_spaces())
        if (space->card.name == name) return space;
    return nullptr;
}

} // namespace scanout::shade
