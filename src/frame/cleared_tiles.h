// Fast clear: the tiles of the back buffer that have held only the background since an earlier
// frame. If nothing is drawn in such a tile again, it need not be cleared.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace scanout::frame {

class ClearedTiles {
public:
    // Two frames with equal layouts cut the back buffer into the same tiles with the same
    // background.
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
    // Something other than the tiles has written to the back buffer.
    void forget() { layout_.reset(); }

    bool is_cleared(int tile) const { return cleared_[static_cast<std::size_t>(tile)] != 0; }
    void set_cleared(int tile, bool cleared) {
        cleared_[static_cast<std::size_t>(tile)] = cleared ? 1 : 0; // a byte: no word is shared
    }

private:
    std::optional<Layout> layout_;
    std::vector<std::uint8_t> cleared_;
};

} // namespace scanout::frame
