#include "image/convolution.h"

#include "techniques.h"

#include <array>

namespace scanout::image {

#define SCANOUT_DECLARE(name) extern const Convolution name;
namespace convolution {
SCANOUT_CONVOLUTION(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

std::span<const Convolution* const> convolutions() {
#define SCANOUT_ROW(name) &convolution::name,
    static constexpr auto kAll =
        std::to_array<const Convolution*>({SCANOUT_CONVOLUTION(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const Convolution* find_convolution(std::string_view name) {
    for (const Convolution* found : convolutions())
        if (found->card.name == name) return found;
    return nullptr;
}

} // namespace scanout::image
