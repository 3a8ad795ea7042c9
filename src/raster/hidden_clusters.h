// Which clusters of triangles were hidden when they were asked about last: a guess, kept from frame
// to frame of one view. Those wait until a tile has drawn all others, and are drawn only where
// these do not hide them. No picture depends on the guess.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::raster {

class HiddenClusters {
public:
    void begin_frame(std::size_t clusters);
    // Does this one wait? Asked once a frame at most. What is drawn waits once in a while, too: so
    // one that has come to be hidden is found. Not in the first frame, which may be the only one.
    bool waits(std::size_t cluster);
    // It waits, and some tile does not hide it. From any thread.
    void show(std::size_t cluster);

private:
    // From frame to frame a cluster is drawn at once, or hidden; in a frame that asks about it, a
    // hidden one waits, and may be shown after all.
    enum : std::uint8_t { kDrawn, kHidden, kWaits, kShown };
    std::vector<std::uint8_t> state_;
    std::size_t frame_ = 0;
    static constexpr std::size_t kNever = 0;
    std::size_t period_ = kNever; // frames from one time that it waits to the next
};

} // namespace scanout::raster
