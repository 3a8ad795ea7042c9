#include "app/view/pick.h"

#include "math/predicates.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace scanout::app {
namespace {

class Picker {
public:
    Picker(const geom::Mesh& mesh, const scene::View& view, int width, int height)
        : mesh_(mesh), perspective_(view.projection == scene::Projection::perspective),
          seen_(mesh.position.size()), pixel_(mesh.position.size()) {
        for (std::size_t v = 0; v < seen_.size(); ++v) {
            seen_[v] = view.linear * DVec3(mesh.position[v]) + view.translation;
            nearest_ = std::max(nearest_, seen_[v].z);
            pixel_[v] = scene::picture_point(view, seen_[v], width, height);
        }
    }

    std::optional<std::uint32_t> at(const DVec2& pointer) const {
        std::vector<std::tuple<double, double, std::uint32_t>> near;
        const auto consider = [&](std::uint32_t v) {
            if (perspective_ && !(seen_[v].z < 0)) return;
            const DVec2 d = pixel_[v] - pointer;
            const double squared = d.x * d.x + d.y * d.y;
            if (squared <= double{kPickPixels} * kPickPixels)
                near.emplace_back(squared, -seen_[v].z, v);
        };
        for (const auto* const list : {&mesh_.index, &mesh_.line_index, &mesh_.point_index})
            std::for_each(list->begin(), list->end(), consider);
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        for (const auto& candidate : near)
            if (is_seen(std::get<2>(candidate))) return std::get<2>(candidate);
        return std::nullopt;
    }

private:
    bool is_seen(std::uint32_t v) const {
        const DVec3& p = seen_[v];
        const DVec3 eye = perspective_ ? DVec3(0) : DVec3(p.x, p.y, nearest_ + 1);
        for (std::size_t i = 0; i < mesh_.index.size(); i += 3) {
            const std::uint32_t* const corner = &mesh_.index[i];
            if (may_hide(corner, v) && hides(corner, eye, p)) return false;
        }
        return true;
    }

    // Around its pixel; a pixel more, for rounding.
    bool may_hide(const std::uint32_t* corner, std::uint32_t v) const {
        if (perspective_ &&
            std::any_of(corner, corner + 3, [&](std::uint32_t c) { return !(seen_[c].z < 0); }))
            return true;
        const auto [left, right] =
            std::minmax({pixel_[corner[0]].x, pixel_[corner[1]].x, pixel_[corner[2]].x});
        const auto [top, bottom] =
            std::minmax({pixel_[corner[0]].y, pixel_[corner[1]].y, pixel_[corner[2]].y});
        return left - 1 <= pixel_[v].x && pixel_[v].x <= right + 1 && top - 1 <= pixel_[v].y &&
               pixel_[v].y <= bottom + 1;
    }

    // Does the triangle lie across the way from the eye to p, its edges included?
    bool hides(const std::uint32_t* corner, const DVec3& eye, const DVec3& p) const {
        const DVec3 &a = seen_[corner[0]], &b = seen_[corner[1]], &c = seen_[corner[2]];
        if (a == p || b == p || c == p) return false;
        if (orient3d(a, b, c, eye) * orient3d(a, b, c, p) >= 0) return false;
        const int ab = orient3d(eye, p, a, b), bc = orient3d(eye, p, b, c),
                  ca = orient3d(eye, p, c, a);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    }

    const geom::Mesh& mesh_;
    bool perspective_;
    std::vector<DVec3> seen_; // view space
    std::vector<DVec2> pixel_;
    double nearest_ = 0;
};

} // namespace

std::optional<std::uint32_t> seen_vertex(const geom::Mesh& mesh, const scene::View& view, int width,
                                         int height, PixelPlace at) {
    return Picker(mesh, view, width, height).at({at.x + 0.5, at.y + 0.5});
}

} // namespace scanout::app
