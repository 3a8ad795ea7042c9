#include "shade/transparency/transparency_pass.h"

#include "shade/check_lanes.h"

#include <algorithm>
#include <bit>

namespace scanout::shade {

using raster::kTileSize;

struct TransparencyPass::Task {
    const raster::Geometry& geometry;
    const GatherInput& in;
    const raster::VisibilityTile& visibility;
    Gatherer& gatherer;
    PixelSink& sink;
};

namespace {

constexpr int kBlockSide = 8;          // pixels; parts of a tile are made of such blocks
constexpr std::size_t kBlockLists = 4; // a block may fill so many times the length of a list

image::Rect common(const image::Rect& a, const image::Rect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

int pixel_of(const raster::VisibilityTile& tile, int x, int y) {
    return (y - tile.area().y0) * kTileSize + (x - tile.area().x0);
}

} // namespace

float BlendList::depth_at(const BlendFragment& f, int sample) const {
    const auto before = static_cast<std::uint16_t>(f.mask & ((1U << sample) - 1));
    return depth[f.depths + static_cast<std::uint32_t>(std::popcount(before))];
}

std::size_t TransparencyPass::bytes() const {
    const auto of = [](const auto& list) {
        return list.capacity() * sizeof(decltype(*list.data()));
    };
    return sizeof *this + probe_.bytes() + opaque_base_.bytes() + of(alpha_) + of(triangles_) +
           of(boxes_) + of(candidates_) + of(pixels_.list.fragments) + of(pixels_.list.depth) +
           of(pixels_.of_pixel) + of(pixels_.start) + of(pixels_.transmittance) + of(pixels_.slot) +
           of(at_sample_) + (colour_blend_ != nullptr ? colour_blend_->bytes() : 0);
}

// Alpha is that of the texture itself: in smaller ones the means of holes and threads are all above
// the threshold somewhere, or all below it, and the whole surface would vanish in the distance.
void TransparencyPass::cut_out(const raster::Geometry& geometry, int tile, const GatherInput& input,
                               raster::VisibilityTile& visibility) {
    geometry.of_mode(tile, raster::AlphaMode::cut_out, triangles_);
    if (triangles_.empty()) return;
    const MipChains none;
    GatherInput in = input;
    in.mips = &none;
    probe_.reset(visibility, visibility.area());
    candidates_.clear();
    alpha_evaluator_.begin(in, AlphaEvaluator::At::sample, alpha_);
    constexpr std::size_t kMaxCandidates = 1 << 15;
    for (const std::uint32_t triangle : triangles_) {
        const image::Rect box = common(probe_.draw(geometry, triangle), visibility.area());
        for (int s = 0; s < visibility.samples(); ++s) {
            for (int y = box.y0; y < box.y1; ++y) {
                for (int x = box.x0; x < box.x1; ++x) {
                    if (!probe_.covers(x, y, s)) continue;
                    candidates_.push_back({triangle, probe_.depth(x, y, s),
                                           static_cast<std::uint16_t>(pixel_of(visibility, x, y)),
                                           static_cast<std::uint8_t>(s)});
                    alpha_evaluator_.add(triangle, x, y,
                                         visibility.pattern()[static_cast<std::size_t>(s)]);
                }
            }
        }
        if (candidates_.size() < kMaxCandidates) continue;
        draw_candidates(in, visibility);
        alpha_evaluator_.begin(in, AlphaEvaluator::At::sample, alpha_);
    }
    draw_candidates(in, visibility);
}

// The nearest wins, whichever comes first.
void TransparencyPass::draw_candidates(const GatherInput& in, raster::VisibilityTile& visibility) {
    alpha_evaluator_.finish();
    const image::Rect& area = visibility.area();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Candidate& c = candidates_[i];
        const scene::Material& material = in.material(in.mesh->material[c.id]);
        if (alpha_[i] >= material.alpha_cut.value_or(in.transparency->cut))
            visibility.draw_sample(area.x0 + c.pixel % kTileSize, area.y0 + c.pixel / kTileSize,
                                   c.sample, c.depth, c.id);
    }
    candidates_.clear();
}

const raster::VisibilityTile&
TransparencyPass::opaque_base(const raster::Geometry& geometry, int tile,
                              const raster::VisibilityTile& visibility) {
    opaque_base_ = visibility;
    geometry.of_mode(tile, raster::AlphaMode::blended, triangles_);
    for (const std::uint32_t triangle : triangles_)
        geometry.draw_one(triangle, opaque_base_);
    return opaque_base_;
}

std::uint64_t TransparencyPass::shade(const raster::Geometry& geometry, int tile,
                                      const GatherInput& in,
                                      const raster::VisibilityTile& visibility, Gatherer& gatherer,
                                      PixelSink& sink) {
    geometry.of_mode(tile, raster::AlphaMode::blended, triangles_);
    if (triangles_.empty()) return visibility.empty() ? 0 : gatherer.shade(visibility, in, sink);
    if (in.transparency->blended->sort_triangles != nullptr)
        in.transparency->blended->sort_triangles(triangles_, in);
    boxes_.clear();
    if (in.transparency->blend->compose != nullptr && colour_blend_ == nullptr)
        colour_blend_ = std::make_unique<ColourBlend>();
    pixels_.colour_blend = colour_blend_.get();
    return shade_region({geometry, in, visibility, gatherer, sink},
                        {visibility.area(), 0, triangles_.size()});
}

// A list that is full is drawn in parts of half the pixels; a single pixel may have as many
// fragments as there are triangles. Each part looks at its own triangles alone, so that the work
// grows with the fragments.
std::uint64_t TransparencyPass::shade_region(const Task& task, const Region& region) {
    if (find(task, region))
        return task.gatherer.shade(task.visibility, task.in, task.sink, &pixels_);
    for (std::size_t i = boxes_.size(); i < region.end; ++i) // the whole tile's, the first time
        boxes_.push_back(task.geometry.pixels_of(triangles_[i], region.pixels));
    const auto half = [](int size) {
        return size > kBlockSide ? (size / 2 + kBlockSide - 1) / kBlockSide * kBlockSide : size / 2;
    };
    image::Rect first = region.pixels, second = region.pixels;
    if (first.height() >= first.width())
        first.y1 = second.y0 = first.y0 + half(first.height());
    else
        first.x1 = second.x0 = first.x0 + half(first.width());
    return shade_part(task, region, first) + shade_part(task, region, second);
}

std::uint64_t TransparencyPass::shade_part(const Task& task, const Region& of,
                                           const image::Rect& pixels) {
    const auto touches = [&](std::size_t i) { return !common(boxes_[i], pixels).empty(); };
    std::size_t count = 0;
    for (std::size_t i = of.begin; i < of.end; ++i)
        count += touches(i) ? 1 : 0;
    if (count > (of.end - of.begin) / 2) // so that all lists together are no longer than the first
        return shade_region(task, {pixels, of.begin, of.end});
    const std::size_t begin = triangles_.size();
    for (std::size_t i = of.begin; i < of.end; ++i) {
        if (!touches(i)) continue;
        triangles_.push_back(triangles_[i]);
        boxes_.push_back(boxes_[i]);
    }
    const std::uint64_t items = shade_region(task, {pixels, begin, triangles_.size()});
    triangles_.resize(begin);
    boxes_.resize(begin);
    return items;
}

// False when there are too many.
bool TransparencyPass::find(const Task& task, const Region& region) {
    const image::Rect& pixels = region.pixels;
    pixels_.region = pixels;
    pixels_.samples = task.visibility.samples();
    probe_.reset(task.visibility, pixels);
    // Parts of a block would set every triangle up again for a few pixels each.
    std::size_t most = task.in.transparency->max_fragments;
    if (std::max(pixels.width(), pixels.height()) <= kBlockSide) most *= kBlockLists;
    BlendList& list = pixels_.list;
    list.fragments.clear();
    list.depth.clear();
    alpha_evaluator_.begin(task.in, AlphaEvaluator::At::centre, alpha_);
    for (std::size_t i = region.begin; i < region.end; ++i) {
        if (i < boxes_.size() && common(boxes_[i], pixels).empty()) continue;
        const std::uint32_t triangle = triangles_[i];
        const image::Rect box = common(probe_.draw(task.geometry, triangle), pixels);
        if (box.empty()) continue;
        find(task, box, triangle);
        if (list.fragments.size() > most && pixels.width() * pixels.height() > 1) return false;
    }
    alpha_evaluator_.finish();
    found_ += list.fragments.size();
    for (std::size_t i = 0; i < list.fragments.size(); ++i)
        list.fragments[i].alpha = alpha_[i];
    sort_by_pixel();
    if (colour_blend_ != nullptr) colour_blend_->begin();
    const auto place =
        colour_blend_ != nullptr ? &TransparencyPass::arrange : &TransparencyPass::weigh;
    for (int row = 0; row < kTileSize; ++row)
        for (std::uint64_t bits = pixels_.rows[static_cast<std::size_t>(row)]; bits != 0;
             bits &= bits - 1)
            (this->*place)(task, row * kTileSize + std::countr_zero(bits));
    if (colour_blend_ != nullptr) colour_blend_->begin_pixels(list.fragments.size());
    note_list();
    if (noted_ == nullptr) return true;
    for (const BlendFragment& f : list.fragments)
        if (f.visible != 0)
            (*noted_)[f.pixel / kTileSize] |= std::uint64_t{1} << f.pixel % kTileSize;
    return true;
}

// By what the list holds, not by the room that earlier tiles made: the same on every worker.
void TransparencyPass::note_list() {
    const BlendList& list = pixels_.list;
    const auto of = [](const auto& held) { return held.size() * sizeof(decltype(*held.data())); };
    longest_list_ =
        std::max(longest_list_, of(list.fragments) + of(list.depth) + of(pixels_.of_pixel) +
                                    of(pixels_.transmittance) + of(alpha_) +
                                    (colour_blend_ != nullptr ? colour_blend_->list_bytes() : 0));
}

void TransparencyPass::find(const Task& task, const image::Rect& box, std::uint32_t triangle) {
    BlendList& list = pixels_.list;
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            unsigned mask = 0;
            for (int s = 0; s < pixels_.samples; ++s)
                mask |= static_cast<unsigned>(probe_.covers(x, y, s)) << s;
            if (mask == 0) continue;
            const auto depths = static_cast<std::uint32_t>(list.depth.size());
            for (unsigned left = mask; left != 0; left &= left - 1)
                list.depth.push_back(probe_.depth(x, y, std::countr_zero(left)));
            list.fragments.push_back({triangle, depths,
                                      static_cast<std::uint16_t>(pixel_of(task.visibility, x, y)),
                                      static_cast<std::uint16_t>(mask), 0, 0, 0});
            alpha_evaluator_.add(
                triangle, x, y,
                task.visibility.pattern()[static_cast<std::size_t>(std::countr_zero(mask))]);
        }
    }
}

// A counting sort: the fragments of a pixel keep their order.
void TransparencyPass::sort_by_pixel() {
    const auto& fragments = pixels_.list.fragments;
    auto& start = pixels_.start;
    start.assign(raster::VisibilityTile::kPlane + 1, 0);
    pixels_.rows.fill(0);
    for (const BlendFragment& f : fragments) {
        ++start[std::size_t{f.pixel} + 1];
        pixels_.rows[f.pixel / kTileSize] |= std::uint64_t{1} << f.pixel % kTileSize;
    }
    for (std::size_t p = 1; p < start.size(); ++p)
        start[p] += start[p - 1];
    pixels_.of_pixel.resize(fragments.size());
    for (std::size_t i = 0; i < fragments.size(); ++i)
        pixels_.of_pixel[start[fragments[i].pixel]++] = static_cast<std::uint32_t>(i);
    for (std::size_t p = start.size() - 1; p > 0; --p) // each was moved to the next one's
        start[p] = start[p - 1];
    start[0] = 0;
    pixels_.slot.resize(raster::VisibilityTile::kPlane);
    pixels_.transmittance.clear();
}

void TransparencyPass::weigh(const Task& task, int pixel) {
    pixels_.slot[static_cast<std::size_t>(pixel)] =
        static_cast<std::uint32_t>(pixels_.transmittance.size());
    const float sample_weight = 1.0F / static_cast<float>(pixels_.samples);
    const auto sort_sample = task.in.transparency->blended->sort_sample;
    const auto meet = task.in.transparency->blend->meet;
    auto& fragments = pixels_.list.fragments;
    for (int s = 0; s < pixels_.samples; ++s) {
        at_sample_.clear();
        for (const std::uint32_t f : pixels_.fragments(pixel))
            if ((fragments[f].mask >> s & 1) != 0) at_sample_.push_back(f);
        if (sort_sample != nullptr) sort_sample(at_sample_, pixels_.list, s);
        float transmittance = 1;
        for (const std::uint32_t f : at_sample_) {
            BlendFragment& fragment = fragments[f];
            const Blend::Weights weights = meet(fragment.alpha, transmittance);
            check_values(std::array{weights.weight, weights.transmittance}, "weight", "blending");
            if (weights.weight != 0) {
                fragment.weight += weights.weight * sample_weight;
                fragment.visible = static_cast<std::uint16_t>(fragment.visible | 1U << s);
            }
            transmittance = weights.transmittance;
            if (transmittance <= 0) break;
        }
        pixels_.transmittance.push_back(transmittance);
    }
}

// All that lets something through: whatever the colours in front, it may be seen.
void TransparencyPass::arrange(const Task& task, int pixel) {
    const auto sort_sample = task.in.transparency->blended->sort_sample;
    auto& fragments = pixels_.list.fragments;
    for (const std::uint32_t f : pixels_.fragments(pixel))
        if (fragments[f].alpha != 0) fragments[f].visible = fragments[f].mask;
    for (int s = 0; s < pixels_.samples; ++s) {
        at_sample_.clear();
        for (const std::uint32_t f : pixels_.fragments(pixel))
            if ((fragments[f].visible >> s & 1) != 0) at_sample_.push_back(f);
        if (sort_sample != nullptr) sort_sample(at_sample_, pixels_.list, s);
        const std::uint32_t place = colour_blend_->add_sample(at_sample_);
        if (s == 0) pixels_.slot[static_cast<std::size_t>(pixel)] = place;
    }
}

} // namespace scanout::shade
