#include "shade/gather.h"

#include "image/dither.h"
#include "shade/check_lanes.h"
#include "shade/corner_light.h"
#include "shade/gather_types.h"
#include "shade/layers.h"
#include "shade/primitives.h"
#include "shade/tile_runs.h"
#include "shade/unlit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <tuple>
#include <utility>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;

struct Gatherer::Seen {
    float depth; // at the first sample that shows it
    Fragment fragment;
};

namespace {

const scene::Material& default_material() {
    static const scene::Material material;
    return material;
}

// The maps of the block's material that some stage of the frame reads; alpha is known by now.
void bind_maps(Block& b, const GatherInput& in) {
    for (std::size_t i = 0; i < kMaps; ++i) {
        const auto map = static_cast<Map>(i);
        const bool read = b.lit && (in.frame->attributes.maps & bit_of(map)) != 0 &&
                          (b.material->*map_slots()[i].map).texture >= 0;
        b.map[i] = read ? bound_map(in, map, *b.material) : BoundMap();
    }
}

// Of one lane.
Run run_at_centre(const Primitive& primitive, int lane, int x, int y) {
    return {&primitive,
            lane,
            1,
            x * kSubpixel + raster::kPixelCentre.x,
            y * kSubpixel + raster::kPixelCentre.y,
            0,
            0};
}

// Does a clipped triangle cover the point (1/256 pixel)?
bool covers(const GatherInput& in, std::uint32_t triangle, std::int32_t x, std::int32_t y) {
    const raster::Pieces pieces = in.geometry->pieces(triangle);
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const raster::Piece& piece) { return raster::covers(piece, x, y); });
}

} // namespace

Run run_at(const GatherInput& in, const Primitive& primitive, int lane, int x, int y,
           raster::SampleOffset sample) {
    Run run = run_at_centre(primitive, lane, x, y);
    const int dx = sample.x - raster::kPixelCentre.x, dy = sample.y - raster::kPixelCentre.y;
    if (!primitive.clipped) {
        run.dx = dx;
        run.dy = dy;
    } else if (!covers(in, primitive.id, run.x, run.y)) {
        // The weights are rounded: the exact edges decide.
        run.x += dx;
        run.y += dy;
    }
    return run;
}

BoundMap bound_map(const GatherInput& in, Map map, const scene::Material& material) {
    const scene::TextureMap& options = material.*map_slots()[map].map;
    return {&in.textures[static_cast<std::size_t>(options.texture)], &options,
            in.mips->find(mip_use(map, options)),
            in.wrap.value_or(options.clamp ? Wrap::clamp : Wrap::repeat)};
}

const scene::Material& GatherInput::material(std::int32_t index) const {
    return index >= 0 ? materials[static_cast<std::size_t>(index)] : default_material();
}

Gatherer::Gatherer()
    : primitives_(std::make_unique<Primitives>()), block_(std::make_unique<Block>()) {}
Gatherer::~Gatherer() = default;

void Gatherer::set_shadow(const TileShadow* shadow) {
    block_->shadow = shadow;
}

std::uint16_t Gatherer::pixel_number(int x, int y) const {
    return static_cast<std::uint16_t>((y - area_.y0) * kTileSize + (x - area_.x0));
}

// The dither of a pixel of the tile.
float Gatherer::offset_at(int pixel) const {
    return image::dither_offset(static_cast<unsigned>(area_.x0 + pixel % kTileSize),
                                static_cast<unsigned>(area_.y0 + pixel / kTileSize));
}

void Gatherer::collect_shared(const raster::VisibilityTile& tile, const GatherInput& in, int x,
                              int y) {
    std::array<std::uint32_t, 16> id{};
    const auto samples = static_cast<std::size_t>(tile.samples());
    for (std::size_t s = 0; s < samples; ++s)
        id[s] = tile.id(x, y, static_cast<int>(s));
    const std::uint16_t pixel = pixel_number(x, y);
    const auto end = id.begin() + static_cast<std::ptrdiff_t>(samples);
    const float share = 1.0F / static_cast<float>(samples);
    const auto share_of = [&](std::uint32_t primitive) {
        return static_cast<float>(std::count(id.begin(), end, primitive)) * share;
    };
    for (std::size_t s = 0; s < samples; ++s) {
        const auto here = id.begin() + static_cast<std::ptrdiff_t>(s);
        // Counted at its first sample in the pixel.
        if (*here == raster::kNoPrimitive || std::find(id.begin(), here, *here) != here) continue;
        const auto [material, lit] = look_of(*in.mesh, *here);
        unsigned mask = 0;
        for (std::size_t other = s; other < samples; ++other)
            mask |= static_cast<unsigned>(id[other] == *here) << other;
        const raster::SampleOffset& at = tile.pattern()[s];
        fragments_.push_back({*here, material, pixel, 1, static_cast<std::uint8_t>(s), lit, 0,
                              static_cast<std::uint16_t>(shared_.size()), share_of(*here),
                              static_cast<std::uint16_t>(mask), byte_of(at.x), byte_of(at.y)});
    }
    shared_.push_back(pixel);
    through_.push_back(share_of(raster::kNoPrimitive));
}

// The surfaces of a pixel that has blended fragments, opaque ones among them, with their weights:
// in the order in which their sum is taken where nothing blends, by the first sample that shows
// them; then by depth there, and by id.
void Gatherer::collect_blended(const raster::VisibilityTile& tile, const GatherInput& in,
                               const BlendedPixels& blended, int x, int y) {
    const std::uint16_t pixel = pixel_number(x, y);
    const float* through = blended.through.data() + blended.slot[pixel];
    const float share = 1.0F / static_cast<float>(tile.samples());
    std::vector<Seen>& seen = seen_;
    seen.clear();
    float background = 0;
    const auto add = [&](std::uint32_t id, int sample, float depth, float weight, unsigned mask) {
        const auto [material, lit] = look_of(*in.mesh, id);
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(sample)];
        seen.push_back({depth,
                        {id, material, pixel, 1, static_cast<std::uint8_t>(sample), lit, 0,
                         static_cast<std::uint16_t>(shared_.size()), weight,
                         static_cast<std::uint16_t>(mask), byte_of(at.x), byte_of(at.y)}});
    };
    for (int s = 0; s < tile.samples(); ++s) {
        const std::uint32_t id = tile.id(x, y, s);
        const float weight = through[s] * share;
        const auto known = std::find_if(seen.begin(), seen.end(),
                                        [&](const Seen& other) { return other.fragment.id == id; });
        if (id == raster::kNoPrimitive)
            background += weight;
        else if (known != seen.end()) {
            known->fragment.weight += weight;
            known->fragment.samples = static_cast<std::uint16_t>(known->fragment.samples | 1U << s);
        } else if (weight > 0)
            add(id, s, tile.depth(x, y, s), weight, 1U << s);
    }
    for (const std::uint32_t i : blended.fragments(pixel)) {
        const BlendFragment& f = blended.list.fragments[i];
        if (f.weight == 0) continue;
        const int first = std::countr_zero(f.shown);
        add(f.id, first, blended.list.depth_at(f, first), f.weight, f.mask);
    }
    if (seen.empty()) return; // nothing shows but the background
    std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
        return std::tuple(a.fragment.sample, b.depth, a.fragment.id) <
               std::tuple(b.fragment.sample, a.depth, b.fragment.id);
    });
    for (std::size_t i = 0; i < seen.size(); ++i) {
        seen[i].fragment.rank = static_cast<std::uint8_t>(std::min<std::size_t>(i, 255));
        fragments_.push_back(seen[i].fragment);
    }
    shared_.push_back(pixel);
    through_.push_back(background);
}

void Gatherer::collect(const raster::VisibilityTile& tile, const GatherInput& in,
                       const BlendedPixels* blended) {
    const image::Rect& area = area_;
    const image::Rect& part = blended != nullptr ? blended->part : area;
    const int width = part.x1 - area.x0;
    for (int row = part.y0 - area.y0; row < part.y1 - area.y0; ++row) {
        RowBits found = row_bits(tile, row);
        const std::uint64_t layered =
            blended != nullptr ? blended->rows[static_cast<std::size_t>(row)] : 0;
        found.shared |= layered;
        for (int x = part.x0 - area.x0; x < width;) {
            if ((found.shared >> x & 1) != 0) {
                if ((layered >> x & 1) != 0 && blended->composed != nullptr)
                    collect_composed(tile, in, *blended, area.x0 + x, area.y0 + row);
                else if ((layered >> x & 1) != 0)
                    collect_blended(tile, in, *blended, area.x0 + x, area.y0 + row);
                else
                    collect_shared(tile, in, area.x0 + x, area.y0 + row);
                ++x;
                continue;
            }
            // The last pixel before another id, before a shared pixel, or of the tile.
            const std::uint64_t stop = found.ends | found.shared >> 1;
            const int last = std::min(x + std::countr_zero(stop >> x), width - 1);
            const std::uint32_t id = tile.id(area.x0 + x, area.y0 + row);
            if (id != raster::kNoPrimitive) {
                const auto [material, lit] = look_of(*in.mesh, id);
                fragments_.push_back({id, material, static_cast<std::uint16_t>(row * kTileSize + x),
                                      static_cast<std::uint8_t>(last - x + 1), 0, lit, 0, kOwn, 1,
                                      0, 0, 0});
            }
            x = last + 1;
        }
    }
}

void Gatherer::collect(raster::AreaTile& tile, const GatherInput& in) {
    for (int y = area_.y0; y < area_.y1; ++y)
        for (int x = area_.x0; x < area_.x1; ++x) {
            const auto found = tile.fragments(x, y);
            if (found.empty()) continue;
            const bool own = found[0].share == 1.0F; // then it is the only one
            const std::uint16_t pixel = pixel_number(x, y);
            float shown = 0;
            for (const raster::AreaFragment& f : found) {
                const auto [material, lit] = look_of(*in.mesh, f.id);
                Fragment* last = fragments_.empty() ? nullptr : &fragments_.back();
                if (own && last != nullptr && last->id == f.id && last->shared == kOwn &&
                    last->pixel + last->count == pixel && x > area_.x0) {
                    ++last->count; // a run goes on, in its row
                    continue;
                }
                fragments_.push_back({f.id, material, pixel, 1, 0, lit, 0,
                                      own ? kOwn : static_cast<std::uint16_t>(shared_.size()),
                                      f.share, 0, byte_of(f.x), byte_of(f.y)});
                shown += f.share;
            }
            if (own) continue;
            shared_.push_back(pixel);
            through_.push_back(shown > 1 - 0x1p-20F ? 0.0F : 1 - shown);
        }
}

void Gatherer::sort_fragments() {
    // One material a block; the order inside a material stays that of the pixels.
    const auto key = [](const Fragment& f) { return std::tuple(f.lit, f.material, f.rank); };
    const auto differs = [&](const Fragment& a, const Fragment& b) { return key(a) != key(b); };
    if (std::adjacent_find(fragments_.begin(), fragments_.end(), differs) != fragments_.end())
        std::stable_sort(fragments_.begin(), fragments_.end(),
                         [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
}

// Lanes for `count` pixels of the fragment, `skip` pixels from its first.
void Gatherer::add_run(const GatherInput& in, const Fragment& f, int skip, int count) {
    Block& b = *block_;
    const int x = area_.x0 + f.pixel % kTileSize + skip;
    const int y = area_.y0 + f.pixel / kTileSize;
    const Primitive& primitive = primitives_->get(in, f.id);
    Run& run = b.run[b.runs++];
    // What covers all samples covers the centre, which lies among them.
    run = run_at_centre(primitive, b.count, x, y);
    if (f.shared != kOwn) run = run_at(in, primitive, b.count, x, y, {f.at_x, f.at_y});
    run.count = count;
    if (primitive.across >= 0) cut_run();
}

// The last run of a row may begin in one piece of its triangle and end in the other.
void Gatherer::cut_run() {
    Block& b = *block_;
    const Run whole = b.run[--b.runs];
    const auto piece = [&](int pixel) {
        return &Primitives::at(*whole.primitive, whole.x + pixel * kSubpixel, whole.y);
    };
    // The last pixel of the piece that has the first one. Slivers are asked at every pixel.
    const auto last = [&](int first) {
        int same = first, other = whole.count;
        if (whole.primitive->across == Primitive::kFolded)
            other = std::min(other, first + 1);
        else if (piece(first) == piece(other - 1))
            same = other - 1;
        while (other - same > 1) {
            const int middle = same + (other - same) / 2;
            (piece(middle) == piece(first) ? same : other) = middle;
        }
        return same;
    };
    for (int first = 0; first < whole.count;) {
        const int end = last(first) + 1;
        Run& run = b.run[b.runs++];
        run = whole;
        run.primitive = piece(first);
        run.first += first;
        run.x += first * kSubpixel;
        run.count = end - first;
        first = end;
    }
}

// Of the block's lanes; null where nothing is dithered.
const float* Gatherer::lane_offsets(const GatherInput& in) {
    if (!in.output.dither) return nullptr;
    offsets_.resize(kRoom);
    for (const Piece& piece : pieces_)
        for (int k = 0; k < piece.count; ++k)
            offsets_[static_cast<std::size_t>(piece.lane + k)] = offset_at(piece.pixel + k);
    return offsets_.data();
}

void Gatherer::finish_block(const GatherInput& in, image::Image& picture) {
    Block& b = *block_;
    if (b.count == 0) return;
    if (b.lit) place_lanes(b, *in.frame, in.rays);
    check_rays(b, *in.frame);
    for (const Stage* stage : in.stages) {
        stage->run(b, *in.frame);
        check_lanes(b, *in.frame, *stage);
    }
    const bool composes = b.blended != nullptr && b.blended->composed != nullptr;
    if (composes) split_pieces();
    if (in.linear != nullptr) {
        keep_linear(*in.linear);
        if (composes) keep_layers(ComposedLayers::Of::linear, 1);
    }
    std::array<std::uint32_t, kRoom> code;
    const bool mixtures = sink_.own != nullptr;
    if (!mixtures || in.output.blend_space->enter != nullptr)
        in.output.encoding->encode(
            {b.colour[0], b.colour[1], b.colour[2], nullptr, lane_offsets(in)}, b.count,
            code.data());
    if (in.output.blend_space->enter != nullptr) in.output.blend_space->enter(b, code.data());
    if (composes) keep_layers(ComposedLayers::Of::mixture, in.output.blend_space->white);
    if (mixtures)
        put_mixtures();
    else
        put_pixels(code.data(), picture);
    pieces_.clear();
    b.count = b.runs = 0;
}

// The pixels that a fragment fills as codes; the others add up.
void Gatherer::put_pixels(const std::uint32_t* code, image::Image& picture) {
    const Block& b = *block_;
    for (const Piece& piece : pieces_) {
        if (piece.shared == kOwn) {
            const int x = area_.x0 + piece.pixel % kTileSize;
            const int y = area_.y0 + piece.pixel / kTileSize;
            std::memcpy(static_cast<void*>(&picture.at(x, y)), code + piece.lane,
                        static_cast<std::size_t>(piece.count) * sizeof(std::uint32_t));
            continue;
        }
        sums_.red[piece.shared] += b.colour[0][piece.lane] * piece.weight;
        sums_.green[piece.shared] += b.colour[1][piece.lane] * piece.weight;
        sums_.blue[piece.shared] += b.colour[2][piece.lane] * piece.weight;
    }
}

// All of them for a filter. What blends counts alike at all samples that it covers.
void Gatherer::put_mixtures() {
    if (sink_.filter == nullptr) return keep_linear(*sink_.own);
    const Block& b = *block_;
    for (const Piece& piece : pieces_) {
        if (piece.shared == kOwn) {
            for (int k = 0; k < piece.count; ++k)
                sink_.own->at(area_.x0 + piece.pixel % kTileSize + k,
                              area_.y0 + piece.pixel / kTileSize) = {
                    b.colour[0][piece.lane + k], b.colour[1][piece.lane + k],
                    b.colour[2][piece.lane + k], 1.0F};
            continue;
        }
        // 1 where it is opaque.
        const float each = piece.weight * static_cast<float>(samples_) /
                           static_cast<float>(std::popcount(piece.samples));
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            const float share = sink_.filter->share(cell, piece.samples) * each;
            std::array<float, 4>& part = parts_[piece.shared][cell];
            for (std::size_t c = 0; c < 3; ++c)
                part[c] += b.colour[c][piece.lane] * share;
            part[3] += share;
        }
    }
}

// Adds the block's lanes; pixels that fragments share are summed in the order of their blocks.
void Gatherer::keep_linear(LinearPicture& linear) const {
    for (const Piece& piece : pieces_) {
        for (int k = 0; k < piece.count; ++k) {
            std::array<float, 4>& pixel = linear.at(area_.x0 + piece.pixel % kTileSize + k,
                                                    area_.y0 + piece.pixel / kTileSize);
            for (std::size_t c = 0; c < 3; ++c)
                pixel[c] += block_->colour[c][piece.lane + k] * piece.weight;
            pixel[3] += piece.weight;
        }
    }
}

void Gatherer::resolve_shared(const GatherInput& in, image::Image& picture) {
    check_sums(sums_, shared_.size());
    codes_.resize(shared_.size() + (kRoom - kLanes));
    std::copy(through_.begin(), through_.end(), sums_.through.begin());
    if (in.output.dither) {
        offsets_.resize(shared_.size() + (kRoom - kLanes));
        for (std::size_t i = 0; i < shared_.size(); ++i)
            offsets_[i] = offset_at(shared_[i]);
    }
    resolve_pixels(sums_, in.output, in.background, in.output.dither ? offsets_.data() : nullptr,
                   static_cast<int>(shared_.size()), codes_.data());
    for (std::size_t i = 0; i < shared_.size(); ++i) {
        const int x = area_.x0 + shared_[i] % kTileSize;
        const int y = area_.y0 + shared_[i] / kTileSize;
        std::memcpy(static_cast<void*>(&picture.at(x, y)), &codes_[i], sizeof codes_[i]);
    }
}

// The shared pixels' parts go where the filter will look for them, behind those of other parts of
// the tile.
void Gatherer::keep_parts() {
    auto& all = sink_.wide->of_tile[sink_.wide->tile_of(area_.x0, area_.y0)];
    for (std::size_t i = 0; i < shared_.size(); ++i)
        sink_.wide->part_at(area_.x0 + shared_[i] % kTileSize, area_.y0 + shared_[i] / kTileSize) =
            static_cast<std::int32_t>(all.size() + i);
    all.insert(all.end(), parts_.begin(), parts_.end());
}

// The last run goes on where the one before it ends: fragments of neighbouring pixels come one by
// one where they blend.
void Gatherer::join_runs() {
    Block& b = *block_;
    if (b.runs > 1 && continues(b.run[b.runs - 2], b.run[b.runs - 1]))
        b.run[--b.runs - 1].count += 1;
}

std::uint64_t Gatherer::shade(const raster::VisibilityTile& tile, const GatherInput& in,
                              image::Image& picture, const BlendedPixels* blended) {
    area_ = tile.area();
    samples_ = tile.samples();
    fragments_.clear();
    shared_.clear();
    through_.clear();
    collect(tile, in, blended);
    block_->blended = blended;
    return shade_fragments(in, picture, blended != nullptr);
}

std::uint64_t Gatherer::shade(raster::AreaTile& tile, const GatherInput& in,
                              image::Image& picture) {
    area_ = tile.area();
    samples_ = 1;
    fragments_.clear();
    shared_.clear();
    through_.clear();
    collect(tile, in);
    block_->blended = nullptr;
    return shade_fragments(in, picture, false);
}

std::uint64_t Gatherer::shade_fragments(const GatherInput& in, image::Image& picture,
                                        bool blended) {
    static_assert(sizeof(image::Rgba8) == sizeof(std::uint32_t));
    primitives_->clear();
    sort_fragments();
    if (sink_.filter != nullptr)
        parts_.assign(shared_.size(), {});
    else
        sums_.reset(shared_.size());
    Block& b = *block_;
    b.ambient = Vec3(0);
    if (in.frame->attributes.corners && corners_ == nullptr) {
        corners_ = std::make_unique<CornerLight>();
        b.corners = corners_.get();
    }
    if (!in.frame->varies.empty()) b.light.resize(in.frame->lights.size());
    check_lights(*in.frame);
    std::uint64_t lanes = 0;
    for (std::size_t i = 0; i < fragments_.size(); ++i) {
        const Fragment& f = fragments_[i];
        if (i == 0 || f.lit != fragments_[i - 1].lit || f.material != fragments_[i - 1].material) {
            finish_block(in, picture);
            b.lit = f.lit;
            b.material = &in.material(f.material);
            const auto surface = f.lit ? surface_of(*b.material) : scene::Surface::matt;
            b.model = in.frame->reflection[static_cast<std::size_t>(surface)];
            bind_maps(b, in);
        }
        for (int done = 0; done < f.count;) {
            if (b.count == kLanes) finish_block(in, picture);
            if (primitives_->full()) {
                finish_block(in, picture);
                primitives_->clear();
            }
            const int count = std::min(f.count - done, kLanes - b.count);
            if (f.lit) {
                add_run(in, f, done, count);
                if (blended && count == 1) join_runs();
            } else {
                for (int k = 0; k < count; ++k) {
                    const int x = area_.x0 + f.pixel % kTileSize + done + k;
                    const int y = area_.y0 + f.pixel / kTileSize;
                    const Vec3 colour = unlit_colour(in, *b.material, f.id, x, y);
                    for (int c = 0; c < 3; ++c)
                        b.albedo[c][b.count + k] = colour[c];
                }
            }
            pieces_.push_back({b.count, count, static_cast<std::uint16_t>(f.pixel + done), f.shared,
                               f.weight, f.samples});
            b.count += count;
            done += count;
        }
        lanes += f.count;
    }
    finish_block(in, picture);
    if (b.blended != nullptr && b.blended->composed != nullptr) put_composed(in);
    if (sink_.filter != nullptr)
        keep_parts();
    else if (!shared_.empty() && sink_.own == nullptr)
        resolve_shared(in, picture);
    return lanes;
}

} // namespace scanout::shade
