#include "textbook/render.h"

#include "math/srgb.h"
#include "textbook/hidden/hidden.h"
#include "textbook/interpolation/interpolation.h"
#include "textbook/light.h"
#include "textbook/line/line.h"
#include "textbook/texture.h"
#include "textbook/wires.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanout::textbook {
namespace {

// The picture as it is drawn.
class Drawing {
public:
    Drawing(const scene::Scene& scene, const scene::View& view, const Look& look,
            const Parts& parts)
        : scene_(scene), look_(look), parts_(parts), scale_(scene::to_floats(view)),
          perspective_(view.projection == scene::Projection::perspective),
          image_(look.width, look.height, look.background) {
        for (const scene::Light& light : look.lights)
            lights_.push_back(scene::in_view(light, view, scene.mesh));
    }

    void shade(const Triangle& t, int y, int x0, int x1) {
        if (current_ != &t) interpolate_ = interpolation_method(parts_.interpolation)(t);
        current_ = &t;
        interpolate_(y, x0, x1, [&](int x, int line, const Values& values) {
            image_.at(x, line) = code_of(shown(values, t.source));
        });
    }

    void draw(const Wire& wire) {
        // A pixel reaches half a pixel to each side of its centre.
        const Box box{-0.5, -0.5, look_.width - 0.5, look_.height - 0.5};
        const auto line = line_clip(parts_.line_clip)({wire.from, wire.to}, box);
        if (!line) return;
        line_method(parts_.line)(pixel_at(line->first), pixel_at(line->second),
                                 [&](int x, int y, double share) {
                                     if (x >= 0 && y >= 0 && x < look_.width && y < look_.height)
                                         mix_in(x, y, material(wire.source), share);
                                 });
    }

    image::Image take() { return std::move(image_); }

private:
    // Of a place in the box, whose right and lower sides round to what lies beyond the picture.
    Pixel pixel_at(const DVec2& p) const {
        const auto nearest = [](double at, int size) {
            return std::clamp(static_cast<int>(std::floor(at + 0.5)), 0, size - 1);
        };
        return {nearest(p.x, look_.width), nearest(p.y, look_.height)};
    }
    static image::Rgba8 code_of(const DVec3& light) {
        const auto code = [](double v) { return srgb_encode(static_cast<float>(v)); };
        return {code(light.x), code(light.y), code(light.z), 255};
    }
    const scene::Material& material(std::uint32_t triangle) const {
        const std::int32_t number = scene_.mesh.material[triangle];
        return number < 0 ? scene_.unnamed : scene_.materials[static_cast<std::size_t>(number)];
    }
    void mix_in(int x, int y, const scene::Material& m, double share) {
        image::Rgba8& there = image_.at(x, y);
        const DVec3 old(srgb_decode(there.r), srgb_decode(there.g), srgb_decode(there.b));
        there = code_of(old + (DVec3(m.diffuse) - old) * share);
    }

    // The pixel's program.
    DVec3 shown(const Values& v, std::uint32_t triangle) const {
        const scene::Material& m = material(triangle);
        Surface s;
        s.place = DVec3(v[kPlace], v[kPlace + 1], v[kPlace + 2]);
        s.normal = unit(DVec3(v[kNormal], v[kNormal + 1], v[kNormal + 2]));
        s.to_eye = perspective_ ? unit(-s.place) : DVec3(0, 0, 1);
        s.diffuse = DVec3(m.diffuse);
        if (look_.vertex_colours)
            s.diffuse = s.diffuse * DVec3(v[kColour], v[kColour + 1], v[kColour + 2]);
        const std::int32_t texture = m.map_diffuse.texture();
        if (look_.textures && texture >= 0 && !scene_.mesh.uv.empty())
            s.diffuse =
                s.diffuse * nearest_texel(scene_.textures[static_cast<std::size_t>(texture)].image,
                                          *m.map_diffuse, v[kUv], v[kUv + 1]);
        s.specular = DVec3(m.specular);
        s.shininess = double{m.shininess};
        s.highlight = look_.highlights && scene::has_highlight(m);
        return light_from(lights_, scale_, s);
    }

    const scene::Scene& scene_;
    const Look& look_;
    const Parts& parts_;
    double scale_;
    bool perspective_;
    image::Image image_;
    std::vector<scene::ViewLight> lights_;
    const Triangle* current_ = nullptr;
    Interpolator interpolate_;
};

} // namespace

Picture render(const scene::Scene& scene, const scene::View& view, const Look& look,
               const Parts& parts) {
    const std::vector<Triangle> triangles = assemble(scene.mesh, view, look, parts);
    const std::vector<Wire> wires = parts.hidden == Hidden::none
                                        ? wires_of(scene.mesh, view, look, parts)
                                        : std::vector<Wire>();
    Drawing drawing(scene, view, look, parts);
    const HiddenTask task{triangles,
                          look.width,
                          look.height,
                          fill_method(parts.fill),
                          parts.conventions.equal_passes,
                          wires,
                          [&](const Wire& wire) { drawing.draw(wire); }};
    hidden_method(parts.hidden)(
        task, [&](const Triangle& t, int y, int x0, int x1) { drawing.shade(t, y, x0, x1); });
    return {drawing.take(), scene.mesh.triangles(), triangles.size()};
}

} // namespace scanout::textbook
