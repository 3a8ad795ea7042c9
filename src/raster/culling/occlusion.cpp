#include "raster/culling/occlusion.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {
namespace {

// Bounds of the period of queries, in frames. It grows while most queried clusters are visible,
// since such queries save nothing.
constexpr std::size_t kOften = 1, kSeldom = 2048;

} // namespace

void OcclusionHistory::begin_frame(std::size_t clusters) {
    if (state_.size() != clusters) { // another mesh: as in the first frame
        state_.assign(clusters, kDrawn);
        period_ = kNever;
        return;
    }
    if (period_ == kNever) period_ = kOften;
    ++frame_;
    // Takes the results of the last frame's queries; clusters beside the picture have none.
    std::size_t occluded = 0, visible = 0;
    for (std::uint8_t& state : state_) {
        occluded += state == kQueried ? 1 : 0;
        visible += state == kQueriedVisible ? 1 : 0;
        if (state == kQueried) state = kOccluded;
        if (state == kQueriedVisible) state = kDrawn;
    }
    if (visible > occluded) period_ = std::min(period_ * 2, kSeldom);
    if (occluded > 3 * visible) period_ = std::max(period_ / 2, kOften);
}

OcclusionHistory::Action OcclusionHistory::next_action(std::size_t cluster) {
    std::uint8_t& state = state_[cluster];
    const bool drawn = state == kDrawn;
    if (drawn && (period_ == kNever || (cluster + frame_) % period_ != 0)) return Action::draw;
    state = kQueried;
    return drawn ? Action::draw_and_query : Action::defer;
}

void OcclusionHistory::set_visible(std::size_t cluster) {
    std::atomic_ref(state_[cluster]).store(kQueriedVisible, std::memory_order_relaxed);
}

} // namespace scanout::raster
