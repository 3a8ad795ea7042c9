// Fast clear: tiles of the back buffer that hold the background alone since an earlier frame. Where
// nothing is drawn again, nothing needs to be cleared.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanout::frame {

class ClearedTiles {
public:
    // What makes tiles of two frames the same pixels.
    struct Layout {
        int width, height, tile_size, tiles;
        image::Rgba8 background;
        friend bool operator==(const Layout&, const Layout&) = default;
    };
    void begin(const Layout& layout) {
        if (layout_ == layout) return;
        layout_ = layout;
        cleared_.assign(static_cast<std::size_t>(layout.tiles), 0);
    }
    // Something but the tiles has written to the back buffer.
    void forget() { layout_.reset(); }

    bool is_cleared(int tile) const { return cleared_[static_cast<std::size_t>(tile)] != 0; }
    void set_cleared(int tile, bool cleared) {
        cleared_[static_cast<std::size_t>(tile)] = cleared ? 1 : 0; // a byte a tile: workers' own
    }

private:
    std::optional<Layout> layout_;
    std::vector<std::uint8_t> cleared_;
};

} // namespace scanout::frame
