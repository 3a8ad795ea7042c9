// Which clusters of triangles were hidden when they were asked about last: a guess, kept from frame
// to frame of one view. Those wait until a tile has drawn all others, and are drawn only where
// these do not hide them. Of what is drawn some are asked about, too: tiles say when they are done
// whether they hide it. No picture depends on the guess.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::raster {

class HiddenClusters {
public:
    void begin_frame(std::size_t clusters);
    // For each cluster once a frame at most. All are asked about in the second frame, later ones
    // once in a while; none in the first, which may be the only one.
    enum class Order : std::uint8_t { draw, draw_and_ask, wait };
    Order order(std::size_t cluster);
    // It is asked about or waits, and some tile does not hide it. From any thread.
    void show(std::size_t cluster);

private:
    // From frame to frame a cluster is drawn at once, or hidden; one that is asked about may be
    // shown.
    enum : std::uint8_t { kDrawn, kHidden, kAsked, kShown };
    std::vector<std::uint8_t> state_;
    std::size_t frame_ = 0;
    static constexpr std::size_t kNever = 0;
    std::size_t period_ = kNever; // frames from one time that it is asked about to the next
};

} // namespace scanout::raster
