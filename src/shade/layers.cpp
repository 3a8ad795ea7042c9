#include "shade/layers.h"

#include "shade/check_lanes.h"

#include <algorithm>
#include <bit>

namespace scanout::shade {

using raster::kTileSize;

struct Layers::Task {
    const raster::Geometry& geometry;
    const GatherInput& in;
    const raster::VisibilityTile& visibility;
    Gatherer& gatherer;
    image::Image& picture;
};

namespace {

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

std::size_t Layers::bytes() const {
    const auto of = [](const auto& list) {
        return list.capacity() * sizeof(decltype(*list.data()));
    };
    return sizeof *this + probe_.bytes() + ground_.bytes() + of(alpha_) + of(triangles_) +
           of(candidates_) + of(pixels_.list.fragments) + of(pixels_.list.depth) +
           of(pixels_.of_pixel) + of(pixels_.start) + of(pixels_.through) + of(pixels_.slot) +
           of(at_sample_) + (composed_ != nullptr ? composed_->bytes() : 0);
}

// Alpha is that of the texture itself: in smaller ones the means of holes and threads are all above
// the threshold somewhere, or all below it, and the whole surface would vanish in the distance.
void Layers::cut_out(const raster::Geometry& geometry, int tile, const GatherInput& input,
                     raster::VisibilityTile& visibility) {
    geometry.of_mode(tile, raster::AlphaMode::cut_out, triangles_);
    if (triangles_.empty()) return;
    const MipChains none;
    GatherInput in = input;
    in.mips = &none;
    probe_.reset(visibility);
    candidates_.clear();
    lanes_.begin(in, AlphaLanes::At::sample, alpha_);
    constexpr std::size_t kMost = 1 << 15;
    for (const std::uint32_t triangle : triangles_) {
        const image::Rect box = common(probe_.draw(geometry, triangle), visibility.area());
        for (int s = 0; s < visibility.samples(); ++s) {
            for (int y = box.y0; y < box.y1; ++y) {
                for (int x = box.x0; x < box.x1; ++x) {
                    if (!probe_.covers(x, y, s)) continue;
                    candidates_.push_back({triangle, probe_.depth(x, y, s),
                                           static_cast<std::uint16_t>(pixel_of(visibility, x, y)),
                                           static_cast<std::uint8_t>(s)});
                    lanes_.add(triangle, x, y, visibility.pattern()[static_cast<std::size_t>(s)]);
                }
            }
        }
        if (candidates_.size() < kMost) continue;
        draw_candidates(in, visibility);
        lanes_.begin(in, AlphaLanes::At::sample, alpha_);
    }
    draw_candidates(in, visibility);
}

// The nearest wins, whichever comes first.
void Layers::draw_candidates(const GatherInput& in, raster::VisibilityTile& visibility) {
    lanes_.finish();
    const image::Rect& area = visibility.area();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Candidate& c = candidates_[i];
        if (alpha_[i] >= in.layers->cut)
            visibility.draw_sample(area.x0 + c.pixel % kTileSize, area.y0 + c.pixel / kTileSize, c.sample,
                            c.depth, c.id);
    }
    candidates_.clear();
}

const raster::VisibilityTile& Layers::ground(const raster::Geometry& geometry, int tile,
                                             const raster::VisibilityTile& visibility) {
    ground_ = visibility;
    geometry.of_mode(tile, raster::AlphaMode::blended, triangles_);
    for (const std::uint32_t triangle : triangles_)
        geometry.draw_one(triangle, ground_);
    return ground_;
}

std::uint64_t Layers::shade(const raster::Geometry& geometry, int tile, const GatherInput& in,
                            const raster::VisibilityTile& visibility, Gatherer& gatherer,
                            image::Image& picture) {
    geometry.of_mode(tile, raster::AlphaMode::blended, triangles_);
    if (triangles_.empty()) return visibility.empty() ? 0 : gatherer.shade(visibility, in, picture);
    if (in.layers->blended->sort_triangles != nullptr)
        in.layers->blended->sort_triangles(triangles_, in);
    probe_.reset(visibility);
    if (in.layers->blend->compose != nullptr && composed_ == nullptr)
        composed_ = std::make_unique<ComposedLayers>();
    pixels_.composed = composed_.get();
    return shade_part({geometry, in, visibility, gatherer, picture}, visibility.area());
}

// A list that is full is drawn in parts of half the pixels; a single pixel may have as many
// fragments as there are triangles.
std::uint64_t Layers::shade_part(const Task& task, const image::Rect& part) {
    if (find(task, part))
        return task.gatherer.shade(task.visibility, task.in, task.picture, &pixels_);
    image::Rect first = part, second = part;
    if (part.height() > 1)
        first.y1 = second.y0 = part.y0 + part.height() / 2;
    else
        first.x1 = second.x0 = part.x0 + part.width() / 2;
    return shade_part(task, first) + shade_part(task, second);
}

// False when there are too many.
bool Layers::find(const Task& task, const image::Rect& part) {
    pixels_.part = part;
    pixels_.samples = task.visibility.samples();
    BlendList& list = pixels_.list;
    list.fragments.clear();
    list.depth.clear();
    lanes_.begin(task.in, AlphaLanes::At::centre, alpha_);
    for (const std::uint32_t triangle : triangles_) {
        const image::Rect box = common(probe_.draw(task.geometry, triangle), part);
        if (!box.empty() && !find(task, box, triangle) && part.width() * part.height() > 1)
            return false;
    }
    lanes_.finish();
    found_ += list.fragments.size();
    for (std::size_t i = 0; i < list.fragments.size(); ++i)
        list.fragments[i].alpha = alpha_[i];
    sort_by_pixel();
    if (composed_ != nullptr) composed_->begin();
    const auto place = composed_ != nullptr ? &Layers::arrange : &Layers::weigh;
    for (int row = 0; row < kTileSize; ++row)
        for (std::uint64_t bits = pixels_.rows[static_cast<std::size_t>(row)]; bits != 0;
             bits &= bits - 1)
            (this->*place)(task, row * kTileSize + std::countr_zero(bits));
    if (composed_ != nullptr) composed_->begin_pixels(list.fragments.size());
    note_list();
    if (noted_ == nullptr) return true;
    for (const BlendFragment& f : list.fragments)
        if (f.shown != 0) (*noted_)[f.pixel / kTileSize] |= std::uint64_t{1} << f.pixel % kTileSize;
    return true;
}

// By what the list holds, not by the room that earlier tiles made: the same on every worker.
void Layers::note_list() {
    const BlendList& list = pixels_.list;
    const auto of = [](const auto& held) { return held.size() * sizeof(decltype(*held.data())); };
    longest_list_ =
        std::max(longest_list_, of(list.fragments) + of(list.depth) + of(pixels_.of_pixel) +
                                    of(pixels_.through) + of(alpha_) +
                                    (composed_ != nullptr ? composed_->list_bytes() : 0));
}

bool Layers::find(const Task& task, const image::Rect& box, std::uint32_t triangle) {
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
            lanes_.add(triangle, x, y,
                       task.visibility.pattern()[static_cast<std::size_t>(std::countr_zero(mask))]);
        }
    }
    return list.fragments.size() <= task.in.layers->most_fragments;
}

// A counting sort: the fragments of a pixel keep their order.
void Layers::sort_by_pixel() {
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
    pixels_.through.clear();
}

void Layers::weigh(const Task& task, int pixel) {
    pixels_.slot[static_cast<std::size_t>(pixel)] =
        static_cast<std::uint32_t>(pixels_.through.size());
    const float share = 1.0F / static_cast<float>(pixels_.samples);
    const auto sort_sample = task.in.layers->blended->sort_sample;
    const auto meet = task.in.layers->blend->meet;
    auto& fragments = pixels_.list.fragments;
    for (int s = 0; s < pixels_.samples; ++s) {
        at_sample_.clear();
        for (const std::uint32_t f : pixels_.fragments(pixel))
            if ((fragments[f].mask >> s & 1) != 0) at_sample_.push_back(f);
        if (sort_sample != nullptr) sort_sample(at_sample_, pixels_.list, s);
        float through = 1;
        for (const std::uint32_t f : at_sample_) {
            BlendFragment& fragment = fragments[f];
            const Blend::Shares shares = meet(fragment.alpha, through);
            check_values(std::array{shares.weight, shares.through}, "share", "blending");
            if (shares.weight != 0) {
                fragment.weight += shares.weight * share;
                fragment.shown = static_cast<std::uint16_t>(fragment.shown | 1U << s);
            }
            through = shares.through;
            if (through <= 0) break;
        }
        pixels_.through.push_back(through);
    }
}

// All that lets something through: whatever the colours in front, it may be seen.
void Layers::arrange(const Task& task, int pixel) {
    const auto sort_sample = task.in.layers->blended->sort_sample;
    auto& fragments = pixels_.list.fragments;
    for (const std::uint32_t f : pixels_.fragments(pixel))
        if (fragments[f].alpha != 0) fragments[f].shown = fragments[f].mask;
    for (int s = 0; s < pixels_.samples; ++s) {
        at_sample_.clear();
        for (const std::uint32_t f : pixels_.fragments(pixel))
            if ((fragments[f].shown >> s & 1) != 0) at_sample_.push_back(f);
        if (sort_sample != nullptr) sort_sample(at_sample_, pixels_.list, s);
        const std::uint32_t place = composed_->add_sample(at_sample_);
        if (s == 0) pixels_.slot[static_cast<std::size_t>(pixel)] = place;
    }
}

} // namespace scanout::shade
