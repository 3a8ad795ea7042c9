// Culling, depth tests and formats by name: techniques.h expanded once. A name without a file is a
// link error.
#include "raster/coverage/depth_rule.h"
#include "raster/culling/cull.h"
#include "techniques.h"

#include <array>

namespace scanout::raster {

#define SCANOUT_DECLARE(name) extern const DepthFormatRow name;
namespace depth {
SCANOUT_DEPTH(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE
#define SCANOUT_DECLARE(name) extern const DepthTestRow name;
namespace depth_test {
SCANOUT_DEPTH_TEST(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

#define SCANOUT_DECLARE(name) extern const CullRow name;
namespace culling {
SCANOUT_CULL(SCANOUT_DECLARE)
}
#undef SCANOUT_DECLARE

namespace {

template <class Row>
const Row* find(std::span<const Row* const> rows, std::string_view name) {
    for (const Row* row : rows)
        if (row->card.name == name) return row;
    return nullptr;
}

} // namespace

std::span<const DepthFormatRow* const> depth_formats() {
#define SCANOUT_ROW(name) &depth::name,
    static constexpr auto kAll = std::to_array<const DepthFormatRow*>({SCANOUT_DEPTH(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

std::span<const DepthTestRow* const> depth_tests() {
#define SCANOUT_ROW(name) &depth_test::name,
    static constexpr auto kAll =
        std::to_array<const DepthTestRow*>({SCANOUT_DEPTH_TEST(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

std::span<const CullRow* const> cullings() {
#define SCANOUT_ROW(name) &culling::name,
    static constexpr auto kAll = std::to_array<const CullRow*>({SCANOUT_CULL(SCANOUT_ROW)});
#undef SCANOUT_ROW
    return kAll;
}

const DepthTestRow* find_depth_test(std::string_view name) {
    return find(depth_tests(), name);
}
const DepthFormatRow* find_depth_format(std::string_view name) {
    return find(depth_formats(), name);
}

} // namespace scanout::raster
