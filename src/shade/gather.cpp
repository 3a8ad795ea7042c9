#include "shade/gather.h"

#include "base/check.h"
#include "raster/clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;

// One primitive in one pixel.
struct Gatherer::Fragment {
    std::uint32_t id;
    std::int32_t material; // index, -1: the default material; lines and points have lit == false
    std::uint16_t pixel;   // in the tile
    std::uint8_t sample;   // at which it is shaded; kCentre: the pixel's centre
    std::uint8_t weight;   // how many of the pixel's samples show it
    bool lit;
};

// What all lanes of one primitive share.
struct Gatherer::PrimitiveSetup {
    std::uint32_t id = raster::kNoPrimitive;
    std::array<std::uint32_t, 3> vertex{};
    std::array<float, 3> inverse_w{};
    std::array<float, 3> facing{};
    bool exact =
        true; // areas from the snapped edge functions; else from the clipped triangle's own
    raster::Edges edges{};
    std::array<DVec3, 3> homogeneous{}; // raster::HomogeneousTriangle::row

    // The areas at a sample (1/256 pixel), not negative; whether the triangle covers it.
    bool area_at(std::int64_t x, std::int64_t y, std::array<float, 3>& area) const;
};

namespace {

constexpr std::uint8_t kCentre = 0xff;
constexpr std::size_t kCacheSize = 256;

const scene::Material& default_material() {
    static const scene::Material material;
    return material;
}

// The triangle's own normal from its vertices in canonical order, brought near length 1 so that a
// float holds it; only its direction matters.
std::array<float, 3> facing_normal(const geom::Mesh& mesh, const std::array<std::uint32_t, 3>& v,
                                   bool negate) {
    const DVec3 p0(mesh.position[v[0]]), p1(mesh.position[v[1]]), p2(mesh.position[v[2]]);
    DVec3 n = cross3(p1 - p0, p2 - p0);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest > 0) n = n / (negate ? -largest : largest);
    return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

} // namespace

Gatherer::Gatherer() : cache_(kCacheSize), block_(std::make_unique<Block>()) {}
Gatherer::~Gatherer() = default;

bool Gatherer::PrimitiveSetup::area_at(std::int64_t x, std::int64_t y,
                                       std::array<float, 3>& area) const {
    if (exact) {
        std::int64_t sign = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int64_t e = edges.at(static_cast<int>(i), x, y);
            sign |= e + edges.bias[i];
            area[i] = static_cast<float>(e);
        }
        return sign >= 0;
    }
    const auto px = static_cast<double>(x) / kSubpixel, py = static_cast<double>(y) / kSubpixel;
    std::array<double, 3> w{};
    bool covered = true;
    for (std::size_t i = 0; i < 3; ++i) {
        w[i] = (homogeneous[i].x * px + homogeneous[i].y * py) + homogeneous[i].z;
        covered = covered && w[i] >= 0;
        w[i] = std::max(0.0, w[i]); // the snapped edge may lie a little further out
    }
    const double largest = std::max({w[0], w[1], w[2]});
    for (std::size_t i = 0; i < 3; ++i)
        area[i] = static_cast<float>(largest > 0 ? w[i] / largest : 1.0);
    return covered;
}

const Gatherer::PrimitiveSetup& Gatherer::setup(const GatherInput& in, std::uint32_t id) {
    PrimitiveSetup& s = cache_[id % kCacheSize];
    if (s.id == id) return s;
    s.id = id;
    const geom::Mesh& mesh = *in.mesh;
    const std::uint32_t* index = mesh.index.data() + std::size_t{id} * 3;
    const auto vertices = in.geometry->vertices();
    const std::array<raster::ScreenVertex, 3> v = {vertices[index[0]], vertices[index[1]],
                                                   vertices[index[2]]};
    s.exact = v[0].on_screen() && v[1].on_screen() && v[2].on_screen();
    bool clockwise = false;
    if (s.exact) {
        const std::optional<raster::SetUp> t = raster::set_up(v, id);
        CHECK(t); // what is visible has an area
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t from = t->order.vertex[i];
            s.vertex[i] = index[from];
            s.inverse_w[i] = in.transform->perspective ? static_cast<float>(v[from].depth) : 1.0F;
        }
        s.edges = raster::edges_of(t->triangle);
        // In the order that now holds, seen in object space, which a mirrored view turns round.
        clockwise = !t->triangle.flipped;
    } else {
        const raster::HomogeneousTriangle t =
            raster::homogeneous_triangle({in.transform->to_clip(mesh.position[index[0]]),
                                          in.transform->to_clip(mesh.position[index[1]]),
                                          in.transform->to_clip(mesh.position[index[2]])});
        s.homogeneous = t.row;
        for (std::size_t i = 0; i < 3; ++i) {
            s.vertex[i] = index[t.order.vertex[i]];
            s.inverse_w[i] = 1;
        }
        clockwise = t.clockwise;
    }
    s.facing = facing_normal(mesh, s.vertex, clockwise != in.mirrored);
    return s;
}

void Gatherer::collect(const raster::VisibilityTile& tile, const GatherInput& in) {
    fragments_.clear();
    const geom::Mesh& mesh = *in.mesh;
    const auto triangles = static_cast<std::uint32_t>(mesh.triangles());
    const auto lines = static_cast<std::uint32_t>(mesh.lines());
    const image::Rect& area = tile.area();
    std::array<std::uint32_t, 16> samples{};
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x) {
            const std::span<std::uint32_t> ids(samples.data(),
                                               static_cast<std::size_t>(tile.samples()));
            for (std::size_t i = 0; i < ids.size(); ++i)
                ids[i] = tile.id(x, y, static_cast<int>(i));
            const auto pixel =
                static_cast<std::uint16_t>((y - area.y0) * kTileSize + (x - area.x0));
            for (std::size_t s = 0; s < ids.size(); ++s) {
                const std::uint32_t id = ids[s];
                // Counted at its first sample in the pixel.
                if (id == raster::kNoPrimitive ||
                    std::find(ids.begin(), ids.begin() + s, id) != ids.begin() + s)
                    continue;
                const auto weight =
                    static_cast<std::uint8_t>(std::count(ids.begin() + s, ids.end(), id));
                Fragment f{id,     -1,
                           pixel,  ids.size() == 1 ? kCentre : static_cast<std::uint8_t>(s),
                           weight, true};
                if (id < triangles) {
                    f.material = mesh.material[id];
                } else {
                    f.lit = false;
                    f.material = id - triangles < lines
                                     ? mesh.line_material[id - triangles]
                                     : mesh.point_material[id - triangles - lines];
                }
                fragments_.push_back(f);
            }
        }
    }
    // One material a block; the order inside a material stays that of the pixels.
    const auto key = [](const Fragment& f) { return std::pair(f.lit, f.material); };
    const auto differs = [&](const Fragment& a, const Fragment& b) { return key(a) != key(b); };
    if (std::adjacent_find(fragments_.begin(), fragments_.end(), differs) != fragments_.end())
        std::stable_sort(fragments_.begin(), fragments_.end(),
                         [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
}

namespace {

// A line or point in a pixel: its vertices and their perspective-correct weights.
struct UnlitLane {
    std::array<std::uint32_t, 3> vertex;
    std::array<float, 3> weight{1, 0, 0};
};

UnlitLane unlit_lane(const GatherInput& in, std::uint32_t id, int x, int y) {
    const geom::Mesh& mesh = *in.mesh;
    const std::size_t line = id - mesh.triangles();
    if (line >= mesh.lines()) {
        const std::uint32_t at = mesh.point_index[line - mesh.lines()];
        return {{at, at, at}};
    }
    std::uint32_t from = mesh.line_index[line * 2], to = mesh.line_index[line * 2 + 1];
    if (!in.frame->attributes.colour) return {{from, from, from}}; // nothing varies along it
    raster::ClipVertex a = in.transform->to_clip(mesh.position[from]),
                       b = in.transform->to_clip(mesh.position[to]);
    if (std::tie(b.y, b.x, b.w) < std::tie(a.y, a.x, a.w)) { // whichever the file names first
        std::swap(a, b);
        std::swap(from, to);
    }
    // The line p = a + t (b - a) where it passes the pixel's centre on its longer axis: linear in t
    // before the divide, so ends behind the eye do no harm.
    const bool along_x = std::abs(b.x * a.w - a.x * b.w) >= std::abs(b.y * a.w - a.y * b.w);
    const double centre = (along_x ? x : y) + 0.5;
    const double before = (along_x ? a.x : a.y) - centre * a.w,
                 after = (along_x ? b.x : b.y) - centre * b.w;
    const double t = before == after ? 0.0 : before / (before - after);
    const double share = t > 0 ? (t < 1 ? t : 1.0) : 0.0;
    return {{from, to, to}, {static_cast<float>(1 - share), static_cast<float>(share), 0}};
}

} // namespace

void Gatherer::fill_lane(const raster::VisibilityTile& tile, const GatherInput& in,
                         const Fragment& f, int lane) {
    Block& b = *block_;
    const int x = tile.area().x0 + f.pixel % kTileSize, y = tile.area().y0 + f.pixel / kTileSize;
    if (!f.lit) {
        const UnlitLane unlit = unlit_lane(in, f.id, x, y);
        for (std::size_t i = 0; i < 3; ++i) {
            b.vertex[i][lane] = unlit.vertex[i];
            b.area[i][lane] = unlit.weight[i];
            b.inverse_w[i][lane] = 1;
        }
        return;
    }
    const PrimitiveSetup& s = setup(in, f.id);
    std::int64_t sx = std::int64_t{x} * kSubpixel + raster::kPixelCentre.x;
    std::int64_t sy = std::int64_t{y} * kSubpixel + raster::kPixelCentre.y;
    std::array<float, 3> area{};
    if (!s.area_at(sx, sy, area) && f.sample != kCentre) {
        const raster::SampleOffset at = tile.pattern()[f.sample];
        sx += at.x - raster::kPixelCentre.x;
        sy += at.y - raster::kPixelCentre.y;
        s.area_at(sx, sy, area);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        b.vertex[i][lane] = s.vertex[i];
        b.inverse_w[i][lane] = s.inverse_w[i];
        b.facing[i][lane] = s.facing[i];
        b.area[i][lane] = area[i];
    }
    const auto px = static_cast<float>(sx) / kSubpixel, py = static_cast<float>(sy) / kSubpixel;
    b.ray_x[lane] = px * in.ray_scale_x + in.ray_offset_x;
    b.ray_y[lane] = py * in.ray_scale_y + in.ray_offset_y;
}

void Gatherer::flush(const raster::VisibilityTile& tile, const GatherInput& in, std::size_t first,
                     std::size_t last, TileColour& out) {
    Block& b = *block_;
    b.count = static_cast<int>(last - first);
    const Fragment& head = fragments_[first];
    b.lit = head.lit;
    b.material = head.material >= 0 ? &in.materials[static_cast<std::size_t>(head.material)]
                                    : &default_material();
    const std::int32_t texture = b.material->map_diffuse.texture;
    b.texture = texture >= 0 && head.lit && in.frame->attributes.uv
                    ? &in.textures[static_cast<std::size_t>(texture)]
                    : nullptr;
    for (int lane = 0; lane < b.count; ++lane)
        fill_lane(tile, in, fragments_[first + static_cast<std::size_t>(lane)], lane);
    for (const Stage* stage : in.stages)
        stage->run(b, *in.frame);
    const float share = 1.0F / static_cast<float>(tile.samples());
    for (int lane = 0; lane < b.count; ++lane) {
        const Fragment& f = fragments_[first + static_cast<std::size_t>(lane)];
        const float weight = static_cast<float>(f.weight) * share;
        out.red[f.pixel] += b.colour[0][lane] * weight;
        out.green[f.pixel] += b.colour[1][lane] * weight;
        out.blue[f.pixel] += b.colour[2][lane] * weight;
        out.covered[f.pixel] = static_cast<std::uint8_t>(out.covered[f.pixel] + f.weight);
    }
}

std::uint64_t Gatherer::shade(const raster::VisibilityTile& tile, const GatherInput& in,
                              TileColour& out) {
    constexpr std::size_t kPixels = std::size_t{kTileSize} * kTileSize;
    for (auto* channel : {&out.red, &out.green, &out.blue})
        channel->assign(kPixels, 0.0F);
    out.covered.assign(kPixels, 0);
    for (PrimitiveSetup& s : cache_)
        s.id = raster::kNoPrimitive; // ids mean another frame's triangles
    collect(tile, in);
    for (std::size_t first = 0; first < fragments_.size();) {
        std::size_t last = first;
        const Fragment& head = fragments_[first];
        while (last < fragments_.size() && last - first < kLanes &&
               fragments_[last].lit == head.lit && fragments_[last].material == head.material)
            ++last;
        flush(tile, in, first, last, out);
        first = last;
    }
    return fragments_.size();
}

} // namespace scanout::shade
