#include "raster/hidden_clusters.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {
namespace {

// What is asked about is drawn but once. Where most are shown, fewer are asked about all the same.
constexpr std::size_t kOften = 1, kSeldom = 2048;

} // namespace

void HiddenClusters::begin_frame(std::size_t clusters) {
    if (state_.size() != clusters) { // as if there were no other frame
        state_.assign(clusters, kDrawn);
        period_ = kNever;
        return;
    }
    if (period_ == kNever) period_ = kOften;
    ++frame_;
    // Of those that the last frame asked about: what is out of sight says nothing.
    std::size_t hidden = 0, shown = 0;
    for (std::uint8_t& state : state_) {
        hidden += state == kAsked ? 1 : 0;
        shown += state == kShown ? 1 : 0;
        if (state == kAsked) state = kHidden;
        if (state == kShown) state = kDrawn;
    }
    if (shown > hidden) period_ = std::min(period_ * 2, kSeldom);
    if (hidden > 3 * shown) period_ = std::max(period_ / 2, kOften);
}

HiddenClusters::Order HiddenClusters::order(std::size_t cluster) {
    std::uint8_t& state = state_[cluster];
    const bool drawn = state == kDrawn;
    if (drawn && (period_ == kNever || (cluster + frame_) % period_ != 0)) return Order::draw;
    state = kAsked;
    return drawn ? Order::draw_and_ask : Order::wait;
}

void HiddenClusters::show(std::size_t cluster) {
    std::atomic_ref(state_[cluster]).store(kShown, std::memory_order_relaxed);
}

} // namespace scanout::raster
