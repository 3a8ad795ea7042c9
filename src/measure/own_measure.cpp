#include "measure/own_measure.h"

#include "base/check.h"
#include "frame/plan/plan.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace scanout::measure {

struct OwnMeasurer::Row {
    OwnMeasure card;
    std::optional<double> (OwnMeasurer::*measure)(const frame::FrameOptions& options);
};

// The table: axis, measure.
const OwnMeasurer::Row OwnMeasurer::kRows[] = {
    {{"interpolate", "texture coordinates off by", "texels"}, &OwnMeasurer::texels},
    {{"texture", "off inside surfaces by", "codes"}, &OwnMeasurer::codes_inside},
    {{"shadow", "wrongly dark or lit", "% of the clear cases"}, &OwnMeasurer::shadows},
    {{"shading", "off inside surfaces by", "codes"}, &OwnMeasurer::codes_inside},
    {{"depth", "depths off by", "2^-24 of the distance"}, &OwnMeasurer::depths},
    {{"transparency", "off where seen through by", "codes"}, &OwnMeasurer::codes_seen_through},
    {{"aa", "edges off by", "pixels"}, &OwnMeasurer::edges},
    {{"render_scale", "off at edges by", "codes"}, &OwnMeasurer::codes_at_edges},
    {{"blend_space", "off at edges by", "codes"}, &OwnMeasurer::codes_at_edges},
    {{"encode", "off inside surfaces by", "codes"}, &OwnMeasurer::codes_inside},
    {{"dither", "means of 8 x 8 pixels off by", "codes"}, &OwnMeasurer::codes_of_squares}};

const OwnMeasure* own_measure(std::string_view axis) {
    const auto row = std::find_if(std::begin(OwnMeasurer::kRows), std::end(OwnMeasurer::kRows),
                                  [&](const OwnMeasurer::Row& r) { return r.card.axis == axis; });
    return row == std::end(OwnMeasurer::kRows) ? nullptr : &row->card;
}

// The scene with one texture on everything whose red grows evenly with u, and green with v.
struct OwnMeasurer::Ramp {
    scene::Scene scene;
    frame::SceneFacts facts;
    Vec2 scale, offset; // from u and v to the texture's
    bool covers = false;

    explicit Ramp(const scene::Scene& from) : scene(from) {
        // Between the middles of two texels a bilinear filter is linear.
        Vec2 low(std::numeric_limits<float>::max()), high(-low);
        for (const Vec2& uv : from.mesh.uv) {
            low = glm::min(low, uv);
            high = glm::max(high, uv);
        }
        covers = !from.mesh.uv.empty() && high.x > low.x && high.y > low.y;
        if (!covers) return;
        for (int c = 0; c < 2; ++c) {
            scale[c] = 0.49F / (high[c] - low[c]);
            offset[c] = 0.255F - low[c] * scale[c];
        }
        scene::Texture texture;
        texture.image = image::Image(2, 2);
        for (int i = 0; i < 4; ++i)
            texture.image.at(i % 2, i / 2) = {static_cast<std::uint8_t>(i % 2 == 0 ? 0 : 255),
                                              static_cast<std::uint8_t>(i / 2 == 1 ? 0 : 255), 0,
                                              255};
        scene::Material material;
        material.diffuse = Vec3(1);
        material.map_diffuse.edit().texture = static_cast<int>(scene.textures.size());
        material.map_diffuse.edit().path = "u and v";
        material.map_diffuse.edit().scale = {scale.x, scale.y, 1};
        material.map_diffuse.edit().offset = {offset.x, offset.y, 0};
        scene.textures.push_back(std::move(texture)); // beside the others, whose sizes say how
        scene.materials.push_back(material);          // exact coordinates must be
        for (std::int32_t& m : scene.mesh.material)
            m = static_cast<std::int32_t>(scene.materials.size()) - 1;
        scene.mesh.colour.clear();
        facts = frame::facts(scene);
    }
};

OwnMeasurer::OwnMeasurer(const scene::Scene& scene, const frame::SceneFacts& facts,
                         const scene::View& view, Jobs& jobs, const Oracle& oracle,
                         const image::Image& reference)
    : scene_(scene), facts_(facts), view_(view), jobs_(jobs), oracle_(oracle),
      reference_(reference), renderer_(jobs) {}
OwnMeasurer::~OwnMeasurer() = default;

std::optional<double> OwnMeasurer::measure(std::string_view axis,
                                           const frame::FrameOptions& options) {
    for (const Row& row : kRows)
        if (row.card.axis == axis) return (this->*row.measure)(options);
    return std::nullopt;
}

template <class F>
void OwnMeasurer::for_pixels(F f) const {
    std::size_t number = 0;
    for (int y = 0; y < reference_.height(); ++y)
        for (int x = 0; x < reference_.width(); ++x)
            f(x, y, number++);
}

std::optional<OwnMeasurer::Drawn> OwnMeasurer::draw(const scene::Scene& scene,
                                                    const frame::SceneFacts& facts,
                                                    frame::FrameOptions options) {
    options.render_scale = "full";
    const auto plan = frame::plan(options, facts, view_);
    if (!plan) return std::nullopt;
    Drawn drawn;
    drawn.picture = renderer_.render(scene, view_, *plan, &drawn.visibility, 64, &drawn.linear);
    CHECK_EQ(drawn.linear.width, reference_.width() * plan->aa->scale);
    CHECK_EQ(drawn.linear.height, reference_.height() * plan->aa->scale);
    return drawn;
}

const std::vector<float>& OwnMeasurer::answers(std::vector<float>& kept,
                                               float (*ask)(const Oracle&, int x, int y)) {
    if (!kept.empty()) return kept;
    const int width = reference_.width();
    kept.resize(reference_.pixels().size());
    jobs_.for_each(reference_.height(), [&](int y, int) {
        for (int x = 0; x < width; ++x)
            kept[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)] = ask(oracle_, x, y);
    });
    return kept;
}

// Of coverage: an edge that is off by a tenth of a pixel covers a tenth of its pixels too much.
std::optional<double> OwnMeasurer::edges(const frame::FrameOptions& options) {
    const auto drawn = draw(options);
    if (!drawn || drawn->linear.pixel.empty()) return std::nullopt;
    const auto& covered = answers(covered_, [](const Oracle& o, int x, int y) {
        return static_cast<float>(o.covered(x, y));
    });
    const int scale = drawn->linear.width / reference_.width();
    double squares = 0;
    std::int64_t edges = 0;
    for_pixels([&](int x, int y, std::size_t i) {
        double share = 0;
        for (int v = 0; v < scale; ++v)
            for (int u = 0; u < scale; ++u)
                share += double{drawn->linear.pixel[static_cast<std::size_t>(
                             (y * scale + v) * drawn->linear.width + x * scale + u)][3]} /
                         (scale * scale);
        const double truth = double{covered[i]}, off = share - truth;
        if (truth == 0 || truth == 1) return;
        squares += off * off;
        ++edges;
    });
    if (edges == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(edges));
}

std::optional<double> OwnMeasurer::depths(const frame::FrameOptions& options) {
    if (view_.projection != scene::Projection::perspective) return std::nullopt;
    frame::FrameOptions one = options;
    frame::ask(one, "aa", "none"); // and no samples
    const auto drawn = draw(one);
    if (!drawn) return std::nullopt;
    double squares = 0;
    std::int64_t compared = 0;
    for_pixels([&](int x, int y, std::size_t i) {
        const std::uint32_t id = drawn->visibility.id[i];
        if (id >= scene_.mesh.triangles()) return;
        const auto place = oracle_.on_triangle(id, x, y);
        if (!place) return; // the middle of the pixel lies on its edge
        const double truth = view_.near_distance / place->distance;
        const double off = (double{drawn->visibility.depth[i]} / truth - 1) * 0x1p24;
        squares += off * off;
        ++compared;
    });
    if (compared == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(compared));
}

std::optional<double> OwnMeasurer::texels(const frame::FrameOptions& options) {
    if (ramp_ == nullptr) ramp_ = std::make_unique<Ramp>(scene_);
    if (!ramp_->covers) return std::nullopt;
    frame::FrameOptions plain;
    plain.width = options.width;
    plain.height = options.height;
    plain.cull = options.cull;
    plain.interpolate = options.interpolate;
    plain.texture = "bilinear";
    plain.tone = "clamp";
    plain.lights.clear();
    scene::Light light;
    light.kind = scene::LightKind::ambient;
    light.power = 1;
    plain.lights.push_back(light);
    const auto drawn = draw(ramp_->scene, ramp_->facts, plain);
    if (!drawn) return std::nullopt;
    double squares = 0;
    std::int64_t compared = 0;
    for_pixels([&](int x, int y, std::size_t i) {
        const std::uint32_t id = drawn->visibility.id[i];
        if (id >= scene_.mesh.triangles() || scene_.mesh.material[id] < 0) return;
        const scene::TextureMap& map =
            scene_.materials[static_cast<std::size_t>(scene_.mesh.material[id])].map_diffuse;
        const auto place = oracle_.on_triangle(id, x, y);
        if (map.texture < 0 || !place) return;
        const image::Image& image = scene_.textures[static_cast<std::size_t>(map.texture)].image;
        const double size[2] = {double{map.scale.x} * image.width(),
                                double{map.scale.y} * image.height()};
        for (int c = 0; c < 2; ++c) {
            const double on_ramp = double{drawn->linear.pixel[i][static_cast<std::size_t>(c)]};
            const double uv =
                (0.25 + on_ramp / 2 - double{ramp_->offset[c]}) / double{ramp_->scale[c]};
            const double off = (uv - place->uv[c]) * size[c];
            squares += off * off;
        }
        ++compared;
    });
    if (compared == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(compared));
}

// What share of the light that shadows may take away arrives: by pictures with shadows, without,
// and without the lights that cast them.
std::optional<double> OwnMeasurer::shadows(const frame::FrameOptions& options) {
    constexpr double kWrong = 0.1; // of the light
    frame::FrameOptions one = options, open, without;
    frame::ask(one, "aa", "none"); // and no samples
    open = without = one;
    open.effects["shadow"] = false;
    without.lights.clear();
    std::copy_if(one.lights.begin(), one.lights.end(), std::back_inserter(without.lights),
                 [](const scene::Light& l) { return !l.casts || is_ambient(l.kind); });
    const auto shadowed = draw(one), lit = draw(open), dark = draw(without);
    if (!shadowed || !lit || !dark) return std::nullopt;
    const auto& truth = answers(lit_, [](const Oracle& o, int x, int y) {
        const auto is_lit = o.is_lit(x, y);
        return !is_lit ? -1.0F : *is_lit ? 1.0F : 0.0F;
    });
    const auto light = [](const Drawn& drawn, std::size_t i) {
        const auto& p = drawn.linear.pixel[i];
        return double{p[0]} + double{p[1]} + double{p[2]};
    };
    std::int64_t clear = 0, wrong = 0;
    for_pixels([&](int, int, std::size_t i) {
        const double most = light(*lit, i) - light(*dark, i);
        if (truth[i] < 0 || most < 0x1p-10) return;
        const double share = (light(*shadowed, i) - light(*dark, i)) / most;
        ++clear;
        wrong += std::abs(share - double{truth[i]}) > kWrong ? 1 : 0;
    });
    if (clear == 0) return std::nullopt;
    return 100.0 * static_cast<double>(wrong) / static_cast<double>(clear);
}

// Root of the mean square over the pixels whose answer is `counts`.
std::optional<double> OwnMeasurer::codes(const frame::FrameOptions& options,
                                         std::vector<float>& mask, float counts,
                                         float (*ask)(const Oracle&, int x, int y)) {
    const auto plan = frame::plan(options, facts_, view_);
    if (!plan) return std::nullopt;
    const image::Image& picture = renderer_.render(scene_, view_, *plan);
    CHECK(picture.width() == reference_.width() && picture.height() == reference_.height());
    answers(mask, ask);
    double squares = 0;
    std::int64_t compared = 0;
    for_pixels([&](int x, int y, std::size_t i) {
        const image::Rgba8 &a = reference_.at(x, y), &b = picture.at(x, y);
        if (mask[i] != counts) return;
        const int r = a.r - b.r, g = a.g - b.g, blue = a.b - b.b;
        squares += (r * r + g * g + blue * blue) / 3.0;
        ++compared;
    });
    if (compared == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(compared));
}

// 1: inside a surface, 0: at an edge, -1: background.
static float inside_or_edge(const Oracle& o, int x, int y) {
    if (!o.is_inside(x, y)) return 0;
    return o.covered(x, y) == 0 ? -1.0F : 1.0F;
}
std::optional<double> OwnMeasurer::codes_inside(const frame::FrameOptions& options) {
    return codes(options, inside_, 1, inside_or_edge);
}
std::optional<double> OwnMeasurer::codes_at_edges(const frame::FrameOptions& options) {
    return codes(options, inside_, 0, inside_or_edge);
}
std::optional<double> OwnMeasurer::codes_seen_through(const frame::FrameOptions& options) {
    return codes(options, seen_through_, 1, [](const Oracle& o, int x, int y) {
        return o.is_seen_through(x, y) ? 1.0F : 0.0F;
    });
}

// What rounding alone moves the mean of a square by, whose light is all but one colour: the
// difference of codes from the light that they were rounded from. Bands are squares that err alike;
// where light changes by more than a code from end to end, there are none.
std::optional<double> OwnMeasurer::codes_of_squares(const frame::FrameOptions& options) {
    constexpr int kSide = 8;
    frame::FrameOptions one = options;
    frame::ask(one, "aa", "none"); // and no samples
    one.encode = "srgb";
    const auto drawn = draw(one);
    if (!drawn || drawn->linear.pixel.empty()) return std::nullopt;
    const auto code = [](double light) {
        light = std::clamp(light, 0.0, 1.0);
        return 255 *
               (light <= 0.0031308 ? 12.92 * light : 1.055 * scanout::pow(light, 1 / 2.4) - 0.055);
    };
    double squares = 0;
    std::int64_t compared = 0;
    for (int top = 0; top + kSide <= drawn->picture.height(); top += kSide)
        for (int left = 0; left + kSide <= drawn->picture.width(); left += kSide) {
            double off[3] = {};
            DVec3 low(255), high(0);
            bool covered = true;
            for (int y = top; y < top + kSide; ++y)
                for (int x = left; x < left + kSide; ++x) {
                    const auto& light =
                        drawn->linear.pixel[static_cast<std::size_t>(y * drawn->linear.width + x)];
                    const image::Rgba8& p = drawn->picture.at(x, y);
                    const std::uint8_t codes[3] = {p.r, p.g, p.b};
                    covered = covered && light[3] >= 1;
                    for (int c = 0; c < 3; ++c) {
                        const double exact = code(double{light[static_cast<std::size_t>(c)]});
                        low[c] = std::min(low[c], exact);
                        high[c] = std::max(high[c], exact);
                        off[c] += (codes[c] - exact) / (kSide * kSide);
                    }
                }
            if (!covered || std::max({high.x - low.x, high.y - low.y, high.z - low.z}) > 1)
                continue;
            for (const double o : off)
                squares += o * o / 3;
            ++compared;
        }
    if (compared == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(compared));
}

void measure_own(std::vector<Ladder>& ladders, const frame::FrameOptions& options,
                 OwnMeasurer& measurer, const std::function<bool()>& stop) {
    for (Ladder& ladder : ladders)
        for (LadderRung& rung : ladder.rungs) {
            if (!rung.point || ladder.is_flat() || stop()) continue;
            frame::FrameOptions with_rung = options;
            frame::ask(with_rung, ladder.axis, rung.technique);
            rung.own = measurer.measure(ladder.axis, with_rung);
        }
}

} // namespace scanout::measure
