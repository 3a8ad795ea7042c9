#include "shade/gather/tile_pixels.h"

#define SIMD_FILE "shade/gather/tile_pixels.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade)

// In a kernel's file because most targets count bits by one instruction.
void find_spans(const std::uint32_t* ids, const std::uint64_t* starts, const std::uint64_t* ends,
                int first, int end, SpanTable& table) {
    std::uint32_t spans = table.spans, buckets = table.buckets;
    for (int row = first; row < end; ++row) {
        for (std::uint64_t rest = starts[row]; rest != 0; rest &= rest - 1) {
            const int x = __builtin_ctzll(rest), pixel = row * raster::kTileSize + x;
            table.add(ids[pixel], pixel, __builtin_ctzll(ends[row] >> x) + 1, spans, buckets);
        }
    }
    table.spans = spans;
    table.buckets = buckets;
}

// offset: where a bucket's pixels begin; afterwards where they end.
void store_spans(const SpanTable& table, std::uint32_t* offset, std::int32_t* pixel) {
    for (const SpanTable::Span *at = table.span, *end = at + table.spans; at != end; ++at) {
        const SpanTable::Span span = *at;
        const auto count = static_cast<int>(span.count());
        const auto first = static_cast<std::int32_t>(span.pixel());
        std::int32_t* const to = pixel + offset[span.bucket()];
        offset[span.bucket()] += span.count();
        for (int k = 0; k < count; k += kLanes) // later places may be filled already
            store_first(iota<I32>(first + k), count - k, to + k);
    }
}

// The pixels of a small triangle, row by row, are those that show its id. Everything else that is
// read with them shows other ids: a row above, columns to the right, and the part of the next row
// in a register. Returns where the pixels end. Triangles are sorted by their number of rows
// (raster::sort_by_rows), so that the branch predictor knows the ends of the loops.
SIMD_INLINE std::int32_t* store_pixels_of(const std::uint32_t* ids, const image::Rect& box,
                                          std::uint32_t id, std::int32_t* to) {
    using raster::kTileSize;
    constexpr int kHalf = kLanes / 2;
    const I32 wanted = static_cast<std::int32_t>(id);
    const auto append = [&](I32 here, I32 pixels)
                            SIMD_LAMBDA { to += store_packed(here == wanted, pixels, to); };
    if (box.x1 - box.x0 <= kHalf) { // two rows a register
        const int rows = (box.y1 - box.y0 + 1) & -2;
        const int first = box.y0 < kTileSize - rows ? box.y0 : kTileSize - rows;
        const int corner = first * kTileSize + box.x0;
        const I32 lane = iota<I32>(0);
        I32 pixels = lane + select(lane < I32(kHalf), I32(corner), I32(corner + kTileSize - kHalf));
        const std::uint32_t* from = ids + corner;
        for (int row = 0; row < rows; row += 2, from += 2 * kTileSize) {
            append(load_halves<I32>(from, from + kTileSize), pixels);
            pixels = pixels + I32(2 * kTileSize);
        }
        return to;
    }
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; x += kLanes) {
            const int pixel = y * kTileSize + x;
            append(load<I32>(ids + pixel), iota<I32>(pixel));
        }
    return to;
}

void find_small_triangles(const raster::BinnedList& list, const std::uint32_t* ids,
                          SmallTrianglePixels& out) {
    SmallTrianglePixels o = out; // no store writes to it
    for (const raster::BinnedTriangle& binned : list.triangles) {
        const std::uint32_t id = list.id_of(binned);
        const auto count =
            static_cast<int>(store_pixels_of(ids, binned.box(), id, o.pixel) - o.pixel);
        if (count > TilePixels::kMaxPixelsOfSmall) {
            for (int k = 0; k < count; k += kLanes)
                store(load<I32>(o.pixel + k), o.large_pixel + k);
            o.large_pixel += count;
            *o.large++ = {id, static_cast<std::uint32_t>(count)};
            continue;
        }
        const I32 number = static_cast<std::int32_t>(o.triangles);
        for (int k = 0; k < TilePixels::kMaxPixelsOfSmall; k += kLanes)
            store(number, o.triangle + k); // items beyond are the next triangle's
        o.pixel += count;
        o.triangle += count;
        o.spatial_index[o.triangles] = binned.spatial_index;
        o.triangles += count > 0 ? 1 : 0;
    }
    out = o;
}
bool packs_lanes() {
    return kPacksLanes;
}

SIMD_END

#if SIMD_ONCE
#include "base/check.h"
#include "raster/screen/primitive.h"
#include "shade/stage.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <tuple>

namespace scanout::shade {

SIMD_REGISTER(find_spans);
SIMD_REGISTER(store_spans);
SIMD_REGISTER(find_small_triangles);
SIMD_REGISTER(packs_lanes);

void SpanTable::clear() {
    std::fill(std::begin(slot), std::end(slot), Slot{raster::kNoPrimitive, 0});
    spans = buckets = 0;
    bucket[0].pixels = 0;
}

TilePixels::TilePixels()
    : table_(std::make_unique<SpanTable>()), offset_(SpanTable::kPixels),
      pixel_(SpanTable::kPixels + kPaddedBlock), triangle_(pixel_.size()), id_(pixel_.size()) {
    table_->clear();
    order_.reserve(SpanTable::kPixels);
    primitive_batches_.reserve(SpanTable::kPixels);
    material_batches_.reserve(SpanTable::kSlots);
}

void TilePixels::clear() {
    if (table_->spans > 0) table_->clear();
    primitive_batches_.clear();
    material_batches_.clear();
    size_ = triangles_ = 0;
}

void TilePixels::add_rows(const std::uint32_t* ids, const InteriorPixels& interior, int first,
                          int end) {
    SIMD_CALL(find_spans, ids, interior.starts.data(), interior.ends.data(), first, end, *table_);
}

void TilePixels::add_ungrouped(std::int32_t material, const std::uint32_t* id, int first,
                               std::uint64_t pixels) {
    if (pixels == 0) return;
    begin_material_batch(material);
    std::size_t triangle = triangles_, size = size_;
    std::uint32_t last = id[std::countr_zero(pixels)];
    for (; pixels != 0; pixels &= pixels - 1, ++size) {
        const int x = std::countr_zero(pixels);
        triangle += id[x] != last ? 1 : 0;
        last = id[x];
        pixel_[size] = first + x;
        triangle_[size] = static_cast<std::int32_t>(triangle);
        id_[triangle] = last;
    }
    triangles_ = triangle + 1;
    material_batches_.back().end = size_ = size;
}

// The search for a triangle's pixels takes about as long as the sorting of four pixels with no more
// than two or three pixels of their triangle beside them; micro-triangles have fewer pixels.
static bool are_few(std::span<const raster::BinnedList> lists, std::size_t pixels) {
    std::size_t triangles = 0, micro = 0;
    for (const raster::BinnedList& list : lists) {
        triangles += list.triangles.size();
        if (list.kind != raster::SmallKind::rows) micro += list.triangles.size();
    }
    return triangles * 4 <= pixels && micro * 2 <= triangles;
}

bool TilePixels::take_small_triangles(std::int32_t material,
                                      std::span<const raster::BinnedList> lists,
                                      const std::uint32_t* ids, int pixels) {
    if (!SIMD_CALL(packs_lanes) || !are_few(lists, static_cast<std::size_t>(pixels))) return false;
    CHECK_EQ(size_ + table_->spans, std::size_t{0});
    large_.resize(SpanTable::kPixels);
    large_pixel_.resize(pixel_.size());
    SmallTrianglePixels found{pixel_.data(),       triangle_.data(), id_.data(), 0,
                              large_pixel_.data(), large_.data()};
    for (const raster::BinnedList& list : lists)
        SIMD_CALL(find_small_triangles, list, ids, found);
    triangles_ = found.triangles;
    size_ = static_cast<std::size_t>(found.pixel - pixel_.data());
    if (size_ > 0) material_batches_.push_back({material, 0, size_});
    for (const SpanTable::Bucket* large = large_.data(); large != found.large; ++large)
        primitive_batches_.push_back({large->id, {material, true}, 0, large->pixels});
    std::copy(large_pixel_.data(), found.large_pixel, pixel_.data() + size_);
    size_ += static_cast<std::size_t>(found.large_pixel - large_pixel_.data());
    CHECK_LE(size_, SpanTable::kPixels); // each pixel once
    return true;
}

// Sorts the table's buckets by key.
void TilePixels::find_order(const ShadingKeys& keys) {
    order_.clear();
    bool sorted = true;
    for (std::uint32_t bucket = 0; bucket < table_->buckets; ++bucket) {
        const ShadingKey key = keys.of(table_->bucket[bucket].id);
        sorted = sorted && (bucket == 0 || key == order_.back().key);
        order_.push_back({key, bucket});
    }
    if (!sorted)
        std::sort(order_.begin(), order_.end(), [](const Order& a, const Order& b) {
            return std::tuple(a.key.lit, a.key.material, a.bucket) <
                   std::tuple(b.key.lit, b.key.material, b.bucket);
        });
}

void TilePixels::store_pixels() {
    if (table_->buckets == 0) return; // take_small_triangles() has stored the pixels
    CHECK_LE(table_->spans, std::uint32_t{SpanTable::kPixels}); // each pixel once
    for (const PrimitiveBatch& batch : primitive_batches_) {
        offset_[batch.bucket] = static_cast<std::uint32_t>(size_);
        size_ += batch.count;
    }
    SIMD_CALL(store_spans, *table_, offset_.data(), pixel_.data());
}

} // namespace scanout::shade
#endif
