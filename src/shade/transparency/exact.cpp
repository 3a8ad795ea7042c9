// Exact order: at every sample all fragments are sorted by their depth there, at a tie by their id,
// however many they are. The A-buffer (Carpenter 1984) with the depth of each sample; [Primer 1.6].
#include "shade/transparency.h"

#include <algorithm>
#include <array>

namespace scanout::shade::transparency {
namespace {

void fragments_nearest_first(std::span<std::uint32_t> fragments, const BlendList& list,
                             int sample) {
    struct Keyed {
        float depth;
        std::uint32_t id, fragment;
        bool operator<(const Keyed& other) const {
            return depth > other.depth || (depth == other.depth && id < other.id);
        }
    };
    const auto keyed = [&](std::uint32_t f) {
        const BlendFragment& fragment = list.fragments[f];
        return Keyed{list.depth_at(fragment, sample), fragment.id, f};
    };
    constexpr std::size_t kMaxOnStack = 16; // most pixels have no more
    if (fragments.size() <= kMaxOnStack) {
        std::array<Keyed, kMaxOnStack> on_stack;
        for (std::size_t i = 0; i < fragments.size(); ++i) {
            const Keyed next = keyed(fragments[i]);
            std::size_t at = i;
            for (; at > 0 && next < on_stack[at - 1]; --at)
                on_stack[at] = on_stack[at - 1];
            on_stack[at] = next;
        }
        for (std::size_t i = 0; i < fragments.size(); ++i)
            fragments[i] = on_stack[i].fragment;
        return;
    }
    std::vector<Keyed> many;
    many.reserve(fragments.size());
    for (const std::uint32_t f : fragments)
        many.push_back(keyed(f));
    std::sort(many.begin(), many.end());
    for (std::size_t i = 0; i < fragments.size(); ++i)
        fragments[i] = many[i].fragment;
}

} // namespace

extern const Transparency exact;
constinit const Transparency exact{
    {.axis = "transparency",
     .name = "exact",
     .blurb = "all fragments of a sample in the order of their depth, without limit",
     .source = "Carpenter 1984, the A-buffer",
     .kind = Kind::rung},
    nullptr,
    fragments_nearest_first,
    false};

} // namespace scanout::shade::transparency
