#include "scene/section.h"

#include "math/bits.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace scanout::scene {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

// Of the caps: a colour that few models have, without a highlight.
Material cap_material() {
    Material material;
    material.name = "section";
    material.diffuse = Vec3(0.80F, 0.19F, 0.07F);
    return material;
}

int index_of(SectionAxis axis) {
    return static_cast<int>(axis);
}

// The least and the largest of dot(normal, p) in the box of the file's space.
std::pair<double, double> range_along(const DVec3& normal, const geom::Mesh& mesh) {
    double low = 0, high = 0;
    for (int i = 0; i < 3; ++i) {
        const double a = normal[i] * mesh.box_min[i], b = normal[i] * mesh.box_max[i];
        low += std::min(a, b);
        high += std::max(a, b);
    }
    return {low, high};
}

} // namespace

std::string to_string(const SectionSpec& s) {
    if (s.axis == SectionAxis::oblique)
        return fmt::format("{:.10g},{:.10g},{:.10g},{:.10g}", s.normal.x, s.normal.y, s.normal.z,
                           s.offset);
    return fmt::format("{}{}:{:.10g}", s.low ? "-" : "",
                       kAxes[static_cast<std::size_t>(index_of(s.axis))], s.share);
}

geom::SectionPlane section_plane(const SectionSpec& s, const geom::Mesh& mesh) {
    geom::SectionPlane plane{DVec3(0), 0};
    const auto square_to = [&](int axis, double at, bool low) { // at: file units
        const double offset = static_cast<float>(scale(at - mesh.centre[axis], -mesh.exponent));
        plane.normal[axis] = low ? -1 : 1;
        plane.offset = low ? -offset : offset;
    };
    if (s.axis != SectionAxis::oblique) {
        const int axis = index_of(s.axis);
        square_to(axis, mesh.box_min[axis] * (1 - s.share) + mesh.box_max[axis] * s.share, s.low);
        return plane;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (s.normal[(axis + 1) % 3] == 0 && s.normal[(axis + 2) % 3] == 0) {
            square_to(axis, s.offset / s.normal[axis], s.normal[axis] < 0);
            return plane;
        }
    const double largest =
        std::max({magnitude(s.normal.x), magnitude(s.normal.y), magnitude(s.normal.z)});
    plane.normal = s.normal / largest;
    plane.offset = scale(s.offset / largest - dot3(plane.normal, mesh.centre), -mesh.exponent);
    return plane;
}

SectionSpec slid(const SectionSpec& spec, double share, const geom::Mesh& mesh) {
    SectionSpec moved = spec;
    if (spec.axis != SectionAxis::oblique) {
        constexpr double kSteps = 10'000; // no digits but those that the user sees
        const auto steps = nearest_integer((spec.share + share) * kSteps);
        moved.share = std::clamp(static_cast<double>(steps) / kSteps, 0.0, 1.0);
        return moved;
    }
    const auto [low, high] = range_along(spec.normal, mesh);
    moved.offset = std::clamp(spec.offset + share * (high - low), low, high);
    return moved;
}

void put_section(Jobs& jobs, const std::optional<SectionSpec>& spec, Scene& scene,
                 std::optional<geom::Mesh>& whole) {
    if (whole) {
        scene.mesh = *std::exchange(whole, std::nullopt);
        scene.materials.pop_back(); // that of the caps
    }
    ++scene.cuts;
    scene.section.reset();
    if (!spec) return;
    SceneSection& made = scene.section.emplace();
    made.plane = to_string(*spec);
    made.triangles = scene.mesh.triangles();
    std::optional<geom::Section> found =
        geom::cut_by_plane(jobs, scene.mesh, section_plane(*spec, scene.mesh),
                           static_cast<std::int32_t>(scene.materials.size()));
    if (!found) return;
    made.cuts = true;
    made.empty = found->mesh.triangles() + found->mesh.lines() + found->mesh.points() == 0;
    made.removed = found->removed;
    made.cut = found->cut;
    made.caps = found->caps;
    made.edges = found->edges;
    made.open_edges = found->open_edges;
    whole = std::exchange(scene.mesh, std::move(found->mesh));
    scene.materials.push_back(cap_material());
}

std::string remark(const SceneSection& s) {
    if (!s.cuts)
        return fmt::format("--section {} changes nothing: nothing of the model lies in front of it",
                           s.plane);
    if (s.empty)
        return fmt::format("--section {} leaves nothing: all of the model lies in front of it; say "
                           "another place, or the other side",
                           s.plane);
    if (s.open_edges > 0)
        return fmt::format("--section {}: the surface is open at the cut: {} of its {} edges close "
                           "no outline, and have no cap",
                           s.plane, s.open_edges, s.edges);
    return {};
}

} // namespace scanout::scene
