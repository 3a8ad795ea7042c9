#include "frame/anti_aliasing.h"

#include "../techniques.h" // that of src; this folder has one of its own

#include <array>

namespace scanout::frame {

#define SCANOUT_DECLARE(name) extern const AntiAliasing name;
namespace aa {
SCANOUT_AA(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const AntiAliasing* const> anti_aliasings() {
#define SCANOUT_ROW(name) &aa::name,
    static constexpr auto kAll = std::to_array<const AntiAliasing*>({SCANOUT_AA(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const AntiAliasing* find_anti_aliasing(std::string_view name) {
    for (const AntiAliasing* found : anti_aliasings())
        if (found->card.name == name) return found;
    return nullptr;
}

} // namespace scanout::frame
