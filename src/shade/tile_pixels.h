// Interior pixels of a tile, which one primitive fills alone, by primitive: each primitive is set
// up once, and its pixels fill registers of lanes whatever rows they lie in. Sorted by counting: a
// pass over the tile finds spans of a row and how many pixels each primitive has, a second one puts
// the spans' pixels where they belong. Where a tile shows few parts of small triangles and nothing
// else, each part's pixels are looked for instead.
#pragma once

#include "raster/coverage.h"
#include "raster/small_triangles.h"
#include "shade/looks.h"
#include "shade/tile_runs.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace scanout::shade {

// Spans as they are found, and the primitives that have them.
struct SpanTable {
    static constexpr std::size_t kSlots = 1024;
    static constexpr int kPixelBits = 12, kCountBits = 6;
    static constexpr std::size_t kPixels = std::size_t{1} << kPixelBits;
    static_assert(raster::kTileSize * raster::kTileSize == 1 << kPixelBits);
    static_assert(raster::kTileSize == 1 << kCountBits);
    struct Slot {
        std::uint32_t id, group;
    };
    struct Span { // in a word: group, pixels less one, first pixel
        std::uint32_t word;
        [[gnu::always_inline]] std::uint32_t pixel() const {
            return word & ((1U << kPixelBits) - 1);
        }
        [[gnu::always_inline]] std::uint32_t count() const {
            return (word >> kPixelBits & ((1U << kCountBits) - 1)) + 1;
        }
        [[gnu::always_inline]] std::uint32_t group() const {
            return word >> (kPixelBits + kCountBits);
        }
    };

    struct Group {
        std::uint32_t id, pixels; // how many; 0 of the one that would come next
    };

    Slot slot[kSlots];  // by id modulo kSlots: the last group there
    Span span[kPixels]; // in the order of the rows
    Group group[kPixels + 1];
    std::uint32_t spans, groups;

    void clear();
    // Pixels of a row side by side; `pixel` is the first, by its number in the tile. Each pixel of
    // the tile once at most.
    void add(std::uint32_t id, int pixel, int count) { add(id, pixel, count, spans, groups); }
    // With counters in registers. No branch: one span in four begins a group, and no processor
    // foresees which.
    [[gnu::always_inline]] void add(std::uint32_t id, int pixel, int count,
                                    std::uint32_t& span_count, std::uint32_t& group_count) {
        Slot& at = slot[id % kSlots];
        const std::uint32_t fresh = at.id != id ? 1 : 0;
        const std::uint32_t of = group_count ^ ((group_count ^ at.group) & (fresh - 1));
        group_count += fresh;
        at = {id, of};
        group[of].id = id;
        group[group_count].pixels = 0;
        group[of].pixels += static_cast<std::uint32_t>(count);
        span[span_count++] = {static_cast<std::uint32_t>(pixel) |
                              static_cast<std::uint32_t>(count - 1) << kPixelBits |
                              of << (kPixelBits + kCountBits)};
    }
};

// Where TilePixels::take_parts() puts what it finds next.
struct PixelsOfParts {
    std::int32_t *pixel, *triangle; // of parts with few pixels, and these parts by number
    std::uint32_t* place;           // of these parts, by that
    std::uint32_t triangles;
    std::int32_t* of_groups; // pixels of the others
    SpanTable::Group* group;
};

class TilePixels {
public:
    // Of a triangle: more are cheaper in registers of their own. Of those of take_parts() more are
    // worth it, for their lanes cost nothing but a number.
    static constexpr int kMost = 24, kMostOfPart = 64;

    TilePixels();
    void clear();

    // Pixels side by side, as in SpanTable.
    void add(std::uint32_t id, int pixel, int count) { table_->add(id, pixel, count); }
    // Those of rows first to end; ids: of the tile's first row.
    void add_rows(const std::uint32_t* ids, const InteriorPixels& interior, int first, int end);
    // Those pixels of a row whose bit is set, `first` and those after it, where most show a
    // triangle of their own: a part, as they come. add() may not go with it.
    void add_scattered(std::int32_t material, const std::uint32_t* id, int first,
                       std::uint64_t pixels);

    // All pixels of a tile that has one sample a pixel, so many pixels, and shows nothing but these
    // parts, whose lanes may all set up their triangles. They need no sorting: each part's are
    // found by its id. Their triangles are named by their places, which are known. Nothing else is
    // added before or after it. Returns false, and does nothing, where sorting takes less time.
    bool take_parts(std::int32_t material, std::span<const raster::TilePartList> lists,
                    const std::uint32_t* ids, int pixels);

    // Sorts what was added. own_lanes(id): may lanes set up this triangle, each for itself? Then
    // its pixels, if they are few, are in a part; else it has a group.
    template <class OwnLanes>
    void arrange(const Looks& looks, const OwnLanes& own_lanes) {
        find_order(looks);
        for (const Order& next : order_) {
            const auto [id, pixels] = table_->group[next.group];
            if (pixels <= kMost && next.look.lit && own_lanes(id))
                add_to_part(next, id, pixels);
            else
                groups_.push_back({id, next.look, next.group, pixels});
        }
        put_pixels();
    }

    // All of them, parts first and then groups.
    std::int32_t* pixels() { return pixel_.data(); }
    std::size_t size() const { return size_; }
    // Triangles of one material, each with few pixels.
    struct Part {
        std::int32_t material;
        std::size_t first, end; // pixels
    };
    std::span<const Part> parts() const { return parts_; }
    // Of a part's pixel: its triangle; from pixel to pixel the same or the next one.
    const std::int32_t* triangles() const { return triangle_.data(); }
    // Of these triangles; after take_parts() their places (geom/clusters.h).
    const std::uint32_t* ids() const { return id_.data(); }
    // One primitive, whose pixels follow those of the group before it. It may have several, where
    // many share the table's slots. Those that look alike stand together.
    struct Group {
        std::uint32_t id;
        Look look;
        std::uint32_t in_table; // its number there
        std::uint32_t count;    // pixels
    };
    std::span<const Group> groups() const { return groups_; }

private:
    struct Order {
        Look look;
        std::uint32_t group;
    };
    void find_order(const Looks& looks);
    void put_pixels();
    void add_to_part(const Order& next, std::uint32_t id, std::uint32_t count) {
        begin_part(next.look.material);
        id_[triangles_] = id;
        using Four __attribute__((vector_size(16))) = std::int32_t;
        const Four number = Four{} + static_cast<std::int32_t>(triangles_++);
        static_assert(kMost == 24);
#pragma GCC unroll 6
        for (std::size_t i = 0; i < kMost; i += 4) // those beyond are the next triangle's
            std::memcpy(&triangle_[size_ + i], &number, sizeof number);
        place_[next.group] = static_cast<std::uint32_t>(size_);
        parts_.back().end = size_ += count;
    }
    void begin_part(std::int32_t material) {
        if (parts_.empty() || parts_.back().material != material)
            parts_.push_back({material, size_, size_});
    }

    std::unique_ptr<SpanTable> table_;
    std::vector<std::uint32_t> place_; // of groups of the table: where their pixels go
    std::vector<Order> order_;
    std::vector<Group> groups_;
    std::vector<Part> parts_;
    std::size_t size_ = 0, triangles_ = 0;
    std::vector<std::int32_t> pixel_, triangle_;
    std::vector<std::uint32_t> id_;
    // Of take_parts(): what becomes groups, and its pixels.
    std::vector<SpanTable::Group> large_;
    std::vector<std::int32_t> of_large_;
};

} // namespace scanout::shade
