#include "shade/tile_pixels.h"

#define SIMD_FILE "shade/tile_pixels.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade)

// In a kernel's file because most targets count bits by one instruction.
void find_spans(const std::uint32_t* ids, const std::uint64_t* starts, const std::uint64_t* ends,
                int first, int end, SpanTable& table) {
    std::uint32_t spans = table.spans, groups = table.groups;
    for (int row = first; row < end; ++row) {
        for (std::uint64_t rest = starts[row]; rest != 0; rest &= rest - 1) {
            const int x = __builtin_ctzll(rest), pixel = row * raster::kTileSize + x;
            table.add(ids[pixel], pixel, __builtin_ctzll(ends[row] >> x) + 1, spans, groups);
        }
    }
    table.spans = spans;
    table.groups = groups;
}

// place: where a group's pixels go, and afterwards where they end.
void put_spans(const SpanTable& table, std::uint32_t* place, std::int32_t* pixel) {
    for (const SpanTable::Span *at = table.span, *end = at + table.spans; at != end; ++at) {
        const SpanTable::Span span = *at;
        const auto count = static_cast<int>(span.count());
        const auto first = static_cast<std::int32_t>(span.pixel());
        std::int32_t* const to = pixel + place[span.group()];
        place[span.group()] += span.count();
        for (int k = 0; k < count; k += kLanes) // what stands behind it may be there already
            store_first(iota<I32>(first + k), count - k, to + k);
    }
}

SIMD_END

#if SIMD_ONCE
#include "base/check.h"
#include "raster/primitive.h"
#include "shade/stage.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <tuple>

namespace scanout::shade {

SIMD_REGISTER(find_spans);
SIMD_REGISTER(put_spans);

void SpanTable::clear() {
    std::fill(std::begin(slot), std::end(slot), Slot{raster::kNoPrimitive, 0});
    spans = groups = 0;
    group[0].pixels = 0;
}

TilePixels::TilePixels()
    : table_(std::make_unique<SpanTable>()), place_(SpanTable::kPixels),
      pixel_(SpanTable::kPixels + kRoom), triangle_(pixel_.size()), id_(SpanTable::kPixels) {
    order_.reserve(SpanTable::kPixels);
    groups_.reserve(SpanTable::kPixels);
    parts_.reserve(SpanTable::kSlots);
    clear();
}

void TilePixels::clear() {
    table_->clear();
    groups_.clear();
    parts_.clear();
    size_ = triangles_ = 0;
}

void TilePixels::add_rows(const std::uint32_t* ids, const OwnPixels& own, int first, int end) {
    SIMD_CALL(find_spans)(ids, own.starts.data(), own.ends.data(), first, end, *table_);
}

void TilePixels::add_scattered(std::int32_t material, const std::uint32_t* id, int first,
                               std::uint64_t pixels) {
    if (pixels == 0) return;
    begin_part(material);
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
    parts_.back().end = size_ = size;
}

// Groups of the table; those that look alike stand together.
void TilePixels::find_order(const Looks& looks) {
    order_.clear();
    bool sorted = true;
    for (std::uint32_t group = 0; group < table_->groups; ++group) {
        const Look look = looks.of(table_->group[group].id);
        sorted = sorted && (group == 0 || look == order_.back().look);
        order_.push_back({look, group});
    }
    if (!sorted)
        std::sort(order_.begin(), order_.end(), [](const Order& a, const Order& b) {
            return std::tuple(a.look.lit, a.look.material, a.group) <
                   std::tuple(b.look.lit, b.look.material, b.group);
        });
}

void TilePixels::put_pixels() {
    CHECK_LE(table_->spans, std::uint32_t{SpanTable::kPixels}); // each pixel once
    for (const Group& group : groups_) {
        place_[group.in_table] = static_cast<std::uint32_t>(size_);
        size_ += group.count;
    }
    SIMD_CALL(put_spans)(*table_, place_.data(), pixel_.data());
}

} // namespace scanout::shade
#endif
