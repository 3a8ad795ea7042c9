// Interior pixels of a tile, which one primitive fills alone, grouped by primitive: each primitive
// is set up once, and its pixels fill registers of items whatever rows they lie in. A counting
// sort: one pass over the tile finds spans of a row and counts the pixels of each primitive, a
// second one stores the spans' pixels in their places. Where a tile shows a few small triangles and
// nothing else, it searches for each triangle's pixels instead.
#pragma once

#include "raster/coverage/coverage.h"
#include "raster/micro/small_triangles.h"
#include "shade/gather/shading_key.h"
#include "shade/gather/tile_runs.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace scanout::shade {

// The counting sort's buckets, one a primitive, and its spans in the order in which they are found.
struct SpanTable {
    static constexpr std::size_t kSlots = 1024;
    static constexpr int kPixelBits = 12, kCountBits = 6;
    static constexpr std::size_t kPixels = std::size_t{1} << kPixelBits;
    static_assert(raster::kTileSize * raster::kTileSize == 1 << kPixelBits);
    static_assert(raster::kTileSize == 1 << kCountBits);
    struct Slot {
        std::uint32_t id, bucket;
    };
    struct Span { // in a word: bucket, pixels less one, first pixel
        std::uint32_t word;
        [[gnu::always_inline]] std::uint32_t pixel() const {
            return word & ((1U << kPixelBits) - 1);
        }
        [[gnu::always_inline]] std::uint32_t count() const {
            return (word >> kPixelBits & ((1U << kCountBits) - 1)) + 1;
        }
        [[gnu::always_inline]] std::uint32_t bucket() const {
            return word >> (kPixelBits + kCountBits);
        }
    };

    struct Bucket {
        std::uint32_t id, pixels; // number of pixels; 0 in the next free one
    };

    Slot slot[kSlots];  // by id modulo kSlots: the last bucket there
    Span span[kPixels]; // in the order of the rows
    Bucket bucket[kPixels + 1];
    std::uint32_t spans, buckets;

    void clear();
    // Adds adjacent pixels of a row; `pixel`: the first one's number in the tile. Each pixel of the
    // tile at most once.
    void add(std::uint32_t id, int pixel, int count) { add(id, pixel, count, spans, buckets); }
    // The same with counters in registers. Has no branch: one span in four begins a bucket, which
    // would cause branch mispredictions.
    [[gnu::always_inline]] void add(std::uint32_t id, int pixel, int count,
                                    std::uint32_t& span_count, std::uint32_t& bucket_count) {
        Slot& at = slot[id % kSlots];
        const std::uint32_t fresh = at.id != id ? 1 : 0;
        const std::uint32_t of = bucket_count ^ ((bucket_count ^ at.bucket) & (fresh - 1));
        bucket_count += fresh;
        at = {id, of};
        bucket[of].id = id;
        bucket[bucket_count].pixels = 0;
        bucket[of].pixels += static_cast<std::uint32_t>(count);
        span[span_count++] = {static_cast<std::uint32_t>(pixel) |
                              static_cast<std::uint32_t>(count - 1) << kPixelBits |
                              of << (kPixelBits + kCountBits)};
    }
};

// The places where TilePixels::take_small_triangles() stores its next finds.
struct SmallTrianglePixels {
    std::int32_t *pixel, *triangle; // of triangles with few pixels, and the triangles' numbers
    std::uint32_t* spatial_index;   // of these triangles, by number
    std::uint32_t triangles;
    std::int32_t* large_pixel; // pixels of the others, which become batches of one primitive
    SpanTable::Bucket* large;
};

class TilePixels {
public:
    // The most pixels of a triangle in a batch of its material: with more, registers of its own are
    // cheaper. The limit is higher in take_small_triangles(), whose items cost only a number each.
    static constexpr int kMaxPixels = 24, kMaxPixelsOfSmall = 64;

    TilePixels();
    void clear();

    // Adds adjacent pixels of a row, as in SpanTable.
    void add(std::uint32_t id, int pixel, int count) { table_->add(id, pixel, count); }
    // Adds the interior pixels of rows first to end; ids: of the tile's first row.
    void add_rows(const std::uint32_t* ids, const InteriorPixels& interior, int first, int end);
    // Appends the pixels of a row whose bits are set, `first` being bit 0, to a batch of the
    // material without grouping them by triangle: cheaper where most pixels show another triangle
    // than their neighbours. Not to be mixed with add().
    void add_ungrouped(std::int32_t material, const std::uint32_t* id, int first,
                       std::uint64_t pixels);

    // Adds all pixels of a tile that has one sample a pixel, has `pixels` of them, and shows only
    // these small triangles, all of which items may set up. Finds each triangle's pixels by its id,
    // without sorting; ids() then holds spatial indices. Nothing else may be added before or after.
    // Returns false, and does nothing, where sorting takes less time.
    bool take_small_triangles(std::int32_t material, std::span<const raster::BinnedList> lists,
                              const std::uint32_t* ids, int pixels);

    // Sorts the added pixels. set_up_per_item(id): can this triangle be set up in the block? Then
    // its pixels, if they are few, go into a batch of its material; else it gets a batch of its
    // own.
    template <class SetUpPerItem>
    void arrange(const ShadingKeys& keys, const SetUpPerItem& set_up_per_item) {
        find_order(keys);
        for (const Order& next : order_) {
            const auto [id, pixels] = table_->bucket[next.bucket];
            if (pixels <= kMaxPixels && next.key.lit && set_up_per_item(id))
                add_to_material_batch(next, id, pixels);
            else
                primitive_batches_.push_back({id, next.key, next.bucket, pixels});
        }
        store_pixels();
    }

    // The sorted pixels: batches of materials first, then of primitives.
    std::int32_t* pixels() { return pixel_.data(); }
    std::size_t size() const { return size_; }
    // Triangles of one material, each with few pixels.
    struct MaterialBatch {
        std::int32_t material;
        std::size_t first, end; // pixels
    };
    std::span<const MaterialBatch> material_batches() const { return material_batches_; }
    // The triangle's number of each pixel in a batch of a material; from pixel to pixel it stays
    // the same or grows by one.
    const std::int32_t* triangles() const { return triangle_.data(); }
    // The ids of these triangles; after take_small_triangles() their spatial indices
    // (geom/clusters.h).
    const std::uint32_t* ids() const { return id_.data(); }
    // One primitive; its pixels follow those of the batch before it. A primitive may have several
    // batches, where many primitives share the table's slots. Batches with equal keys are adjacent.
    struct PrimitiveBatch {
        std::uint32_t id;
        ShadingKey key;
        std::uint32_t bucket; // of the table
        std::uint32_t count;  // pixels
    };
    std::span<const PrimitiveBatch> primitive_batches() const { return primitive_batches_; }

private:
    struct Order {
        ShadingKey key;
        std::uint32_t bucket;
    };
    void find_order(const ShadingKeys& keys);
    void store_pixels();
    void add_to_material_batch(const Order& next, std::uint32_t id, std::uint32_t count) {
        begin_material_batch(next.key.material);
        id_[triangles_] = id;
        using Four __attribute__((vector_size(16))) = std::int32_t;
        const Four number = Four{} + static_cast<std::int32_t>(triangles_++);
        static_assert(kMaxPixels == 24);
#pragma GCC unroll 6
        for (std::size_t i = 0; i < kMaxPixels; i += 4) // the next triangle overwrites the rest
            std::memcpy(&triangle_[size_ + i], &number, sizeof number);
        offset_[next.bucket] = static_cast<std::uint32_t>(size_);
        material_batches_.back().end = size_ += count;
    }
    void begin_material_batch(std::int32_t material) {
        if (material_batches_.empty() || material_batches_.back().material != material)
            material_batches_.push_back({material, size_, size_});
    }

    std::unique_ptr<SpanTable> table_;
    std::vector<std::uint32_t> offset_; // of the table's buckets: where their pixels are stored
    std::vector<Order> order_;
    std::vector<PrimitiveBatch> primitive_batches_;
    std::vector<MaterialBatch> material_batches_;
    std::size_t size_ = 0, triangles_ = 0;
    std::vector<std::int32_t> pixel_, triangle_;
    std::vector<std::uint32_t> id_;
    // For take_small_triangles(): the batches of one primitive, and their pixels.
    std::vector<SpanTable::Bucket> large_;
    std::vector<std::int32_t> large_pixel_;
};

} // namespace scanout::shade
