#include "frame/stencil.h"

#include "../techniques.h" // that of src; this folder has one of its own

#include <array>

namespace scanout::frame {

#define SCANOUT_DECLARE(name) extern const Stencil name;
namespace stencil {
SCANOUT_STENCIL(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const Stencil* const> stencils() {
#define SCANOUT_ROW(name) &stencil::name,
    static constexpr auto kAll = std::to_array<const Stencil*>({SCANOUT_STENCIL(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const Stencil* find_stencil(std::string_view name) {
    for (const Stencil* found : stencils())
        if (found->card.name == name) return found;
    return nullptr;
}

} // namespace scanout::frame
