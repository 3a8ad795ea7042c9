#include "shade/gather.h"

#include "shade/check_lanes.h"
#include "shade/primitives.h"
#include "shade/tile_runs.h"
#include "shade/unlit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;

// One primitive in pixels of a row side by side.
struct Gatherer::Fragment {
    std::uint32_t id;
    std::int32_t material; // index, -1: the default material
    std::uint16_t pixel;   // the first, in the tile
    std::uint8_t count;    // pixels
    std::uint8_t sample;   // the first that shows it
    std::uint8_t weight;   // how many samples show it; if all, the pixels are its own
    bool lit;              // lines and points are not
    std::uint16_t shared;  // otherwise: place in the list of shared pixels
};

struct Gatherer::Piece {
    int lane, count; // of the block
    std::uint16_t pixel, shared;
    std::uint8_t weight;
};

namespace {

const scene::Material& default_material() {
    static const scene::Material material;
    return material;
}

struct Look {
    std::int32_t material;
    bool lit;
};
Look look_of(const geom::Mesh& mesh, std::uint32_t id) {
    const std::size_t triangles = mesh.triangles(), lines = mesh.lines();
    if (id < triangles) return {mesh.material[id], true};
    const std::size_t line = id - triangles;
    return {line < lines ? mesh.line_material[line] : mesh.point_material[line - lines], false};
}

// The maps of the block's material that some stage of the frame reads.
void bind_maps(Block& b, const GatherInput& in) {
    const scene::TextureMap* const maps[kMaps] = {&b.material->map_diffuse};
    for (std::size_t i = 0; i < kMaps; ++i) {
        b.map[i] = {nullptr, maps[i]};
        if (maps[i]->texture >= 0 && b.lit && in.frame->attributes.uv)
            b.map[i].texture = &in.textures[static_cast<std::size_t>(maps[i]->texture)];
    }
}

// Does a clipped triangle cover the point (1/256 pixel)?
bool covers(const GatherInput& in, std::uint32_t triangle, std::int32_t x, std::int32_t y) {
    const raster::Pieces pieces = in.geometry->pieces(triangle);
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const raster::Piece& piece) { return raster::covers(piece, x, y); });
}

} // namespace

Gatherer::Gatherer()
    : primitives_(std::make_unique<Primitives>()), block_(std::make_unique<Block>()) {}
Gatherer::~Gatherer() = default;

void Gatherer::set_shadow(const TileShadow* shadow) {
    block_->shadow = shadow;
}

void Gatherer::collect_shared(const raster::VisibilityTile& tile, const GatherInput& in, int x,
                              int y) {
    std::array<std::uint32_t, 16> id{};
    const auto samples = static_cast<std::size_t>(tile.samples());
    for (std::size_t s = 0; s < samples; ++s)
        id[s] = tile.id(x, y, static_cast<int>(s));
    const auto pixel =
        static_cast<std::uint16_t>((y - tile.area().y0) * kTileSize + (x - tile.area().x0));
    const auto end = id.begin() + static_cast<std::ptrdiff_t>(samples);
    for (std::size_t s = 0; s < samples; ++s) {
        const auto here = id.begin() + static_cast<std::ptrdiff_t>(s);
        // Counted at its first sample in the pixel.
        if (*here == raster::kNoPrimitive || std::find(id.begin(), here, *here) != here) continue;
        const auto [material, lit] = look_of(*in.mesh, *here);
        fragments_.push_back({*here, material, pixel, 1, static_cast<std::uint8_t>(s),
                              static_cast<std::uint8_t>(std::count(here, end, *here)), lit,
                              static_cast<std::uint16_t>(shared_.size())});
    }
    shared_.push_back(pixel);
}

void Gatherer::collect(const raster::VisibilityTile& tile, const GatherInput& in) {
    fragments_.clear();
    shared_.clear();
    const image::Rect& area = tile.area();
    const int width = area.x1 - area.x0;
    for (int row = 0; row < area.y1 - area.y0; ++row) {
        const RowBits found = row_bits(tile, row);
        for (int x = 0; x < width;) {
            if ((found.shared >> x & 1) != 0) {
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
                                      static_cast<std::uint8_t>(last - x + 1), 0,
                                      static_cast<std::uint8_t>(tile.samples()), lit, 0});
            }
            x = last + 1;
        }
    }
    // One material a block; the order inside a material stays that of the pixels.
    const auto key = [](const Fragment& f) { return std::pair(f.lit, f.material); };
    const auto differs = [&](const Fragment& a, const Fragment& b) { return key(a) != key(b); };
    if (std::adjacent_find(fragments_.begin(), fragments_.end(), differs) != fragments_.end())
        std::stable_sort(fragments_.begin(), fragments_.end(),
                         [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
}

// Lanes for `count` pixels of the fragment, `skip` pixels from its first.
void Gatherer::add_run(const raster::VisibilityTile& tile, const GatherInput& in, const Fragment& f,
                       int skip, int count) {
    Block& b = *block_;
    const int x = tile.area().x0 + f.pixel % kTileSize + skip;
    const int y = tile.area().y0 + f.pixel / kTileSize;
    const Primitive& primitive = primitives_->get(in, f.id);
    const raster::SampleOffset at = tile.pattern()[f.sample];
    Run run{&primitive,
            b.count,
            count,
            x * kSubpixel + raster::kPixelCentre.x,
            y * kSubpixel + raster::kPixelCentre.y,
            at.x - raster::kPixelCentre.x,
            at.y - raster::kPixelCentre.y};
    if (f.weight == tile.samples()) {
        // What covers all samples covers the centre, which lies among them.
        run.dx = run.dy = 0;
    } else if (primitive.clipped) {
        // The weights are those of the triangle before the clip: what was drawn decides.
        if (!covers(in, f.id, run.x, run.y)) {
            run.x += run.dx;
            run.y += run.dy;
        }
        run.dx = run.dy = 0;
    }
    b.run[b.runs++] = run;
}

void Gatherer::finish_block(const raster::VisibilityTile& tile, const GatherInput& in,
                            image::Image& picture) {
    Block& b = *block_;
    if (b.count == 0) return;
    if (b.lit) place_lanes(b, *in.frame, in.rays);
    check_rays(b, *in.frame);
    for (const Stage* stage : in.stages) {
        stage->run(b, *in.frame);
        check_lanes(b, *in.frame, *stage);
    }
    if (in.linear != nullptr) keep_linear(tile, *in.linear);
    std::array<std::uint32_t, kRoom> code;
    encode_pixels(b.colour[0], b.colour[1], b.colour[2], b.count, code.data());
    const float share = 1.0F / static_cast<float>(tile.samples());
    for (const Piece& piece : pieces_) {
        if (piece.weight == tile.samples()) {
            const int x = tile.area().x0 + piece.pixel % kTileSize;
            const int y = tile.area().y0 + piece.pixel / kTileSize;
            std::memcpy(static_cast<void*>(&picture.at(x, y)), code.data() + piece.lane,
                        static_cast<std::size_t>(piece.count) * sizeof(std::uint32_t));
            continue;
        }
        const float weight = static_cast<float>(piece.weight) * share;
        sums_.red[piece.shared] += b.colour[0][piece.lane] * weight;
        sums_.green[piece.shared] += b.colour[1][piece.lane] * weight;
        sums_.blue[piece.shared] += b.colour[2][piece.lane] * weight;
        sums_.covered[piece.shared] += piece.weight;
    }
    pieces_.clear();
    b.count = b.runs = 0;
}

// Adds the block's lanes; pixels that fragments share are summed in the order of their blocks.
void Gatherer::keep_linear(const raster::VisibilityTile& tile, LinearPicture& linear) const {
    for (const Piece& piece : pieces_) {
        const float weight = static_cast<float>(piece.weight) / static_cast<float>(tile.samples());
        for (int k = 0; k < piece.count; ++k) {
            std::array<float, 4>& pixel = linear.at(tile.area().x0 + piece.pixel % kTileSize + k,
                                                    tile.area().y0 + piece.pixel / kTileSize);
            for (std::size_t c = 0; c < 3; ++c)
                pixel[c] += block_->colour[c][piece.lane + k] * weight;
            pixel[3] += weight;
        }
    }
}

void Gatherer::resolve_shared(const raster::VisibilityTile& tile, const GatherInput& in,
                              image::Image& picture) {
    check_sums(sums_, shared_.size());
    codes_.resize(shared_.size() + (kRoom - kLanes));
    resolve_pixels(sums_, tile.samples(), in.background, static_cast<int>(shared_.size()),
                   codes_.data());
    for (std::size_t i = 0; i < shared_.size(); ++i) {
        const int x = tile.area().x0 + shared_[i] % kTileSize;
        const int y = tile.area().y0 + shared_[i] / kTileSize;
        std::memcpy(static_cast<void*>(&picture.at(x, y)), &codes_[i], sizeof codes_[i]);
    }
}

std::uint64_t Gatherer::shade(const raster::VisibilityTile& tile, const GatherInput& in,
                              image::Image& picture) {
    static_assert(sizeof(image::Rgba8) == sizeof(std::uint32_t));
    primitives_->clear();
    collect(tile, in);
    sums_.reset(shared_.size());
    Block& b = *block_;
    b.ambient = Vec3(0);
    if (!in.frame->varies.empty()) b.light.resize(in.frame->lights.size());
    std::uint64_t lanes = 0;
    for (std::size_t i = 0; i < fragments_.size(); ++i) {
        const Fragment& f = fragments_[i];
        if (i == 0 || f.lit != fragments_[i - 1].lit || f.material != fragments_[i - 1].material) {
            finish_block(tile, in, picture);
            b.lit = f.lit;
            b.material = f.material >= 0 ? &in.materials[static_cast<std::size_t>(f.material)]
                                         : &default_material();
            bind_maps(b, in);
        }
        for (int done = 0; done < f.count;) {
            if (b.count == kLanes) finish_block(tile, in, picture);
            if (primitives_->full()) {
                finish_block(tile, in, picture);
                primitives_->clear();
            }
            const int count = std::min(f.count - done, kLanes - b.count);
            if (f.lit) {
                add_run(tile, in, f, done, count);
            } else {
                for (int k = 0; k < count; ++k) {
                    const int x = tile.area().x0 + f.pixel % kTileSize + done + k;
                    const int y = tile.area().y0 + f.pixel / kTileSize;
                    const Vec3 colour = unlit_colour(in, *b.material, f.id, x, y);
                    for (int c = 0; c < 3; ++c)
                        b.albedo[c][b.count + k] = colour[c];
                }
            }
            pieces_.push_back(
                {b.count, count, static_cast<std::uint16_t>(f.pixel + done), f.shared, f.weight});
            b.count += count;
            done += count;
        }
        lanes += f.count;
    }
    finish_block(tile, in, picture);
    if (!shared_.empty()) resolve_shared(tile, in, picture);
    return lanes;
}

} // namespace scanout::shade
