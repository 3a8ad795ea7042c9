#include "frame/facts/surroundings.h"

#include "base/check.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace scanout::frame {
namespace {

constexpr int kGrid = 16;        // cells along the model's box
constexpr double kParts = 2048;  // of all the area, so large triangles are cut
constexpr int kMostCuts = 5;     // each into four
constexpr double kUnit = 0x1p20; // of places and normals
constexpr double kAreaUnit = 0x1p36;

struct Sums {
    std::int64_t area = 0, count = 0;
    std::array<std::int64_t, 3> place{}, normal{};
};

std::int64_t whole(double x, double unit) {
    return static_cast<std::int64_t>(x * unit + (x < 0 ? -0.5 : 0.5));
}

// Coordinates are within -1 and 1, where no doubled area is above 12. Sums stop below what a number
// holds, so that their order does not matter even then.
std::int64_t whole_area(double area) {
    return whole(std::min(area, 16.0), kAreaUnit);
}
void add_area(std::int64_t& sum, std::int64_t area) {
    constexpr std::int64_t kMost = std::int64_t{1} << 62;
    sum = std::min(sum + area, kMost);
}

class Collector {
public:
    explicit Collector(const geom::Mesh& mesh) : mesh_(mesh) {
        for (std::size_t t = 0; t < mesh.triangles(); ++t)
            add_area(total_, whole_area(doubled_area(corners_of(t))));
        for (std::size_t t = 0; t < mesh.triangles() && total_ > 0; ++t)
            add(t);
    }

    std::vector<SurfaceCell> cells() const {
        std::vector<SurfaceCell> cells;
        for (const auto& [key, sums] : sums_) {
            SurfaceCell cell;
            DVec3 normal;
            for (int c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(c);
                cell.place[c] = static_cast<double>(sums.place[i]) /
                                (kUnit * static_cast<double>(sums.count) * mesh_.radius);
                normal[c] = static_cast<double>(sums.normal[i]);
            }
            cell.normal = normalized(normal, DVec3(0));
            cell.area = sums.area;
            cells.push_back(cell);
        }
        return cells;
    }

private:
    using Corners = std::array<DVec3, 3>;

    Corners corners_of(std::size_t triangle) const {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = DVec3(mesh_.position[mesh_.index[3 * triangle + k]]);
        return corners;
    }
    static double within(double coordinate) { return std::clamp(coordinate, -1.0, 1.0); }
    static double doubled_area(const Corners& c) {
        return length(cross3(c[1] - c[0], c[2] - c[0]));
    }

    void add(std::size_t triangle) {
        const Corners corners = corners_of(triangle);
        const DVec3 face = cross3(corners[1] - corners[0], corners[2] - corners[0]);
        const double area = length(face);
        if (!(area > 0)) return;
        int cuts = 0;
        double parts = kParts * area / (static_cast<double>(total_) / kAreaUnit);
        for (; parts > 1 && cuts < kMostCuts; parts /= 4)
            ++cuts;
        add_parts(corners, face / area, area, cuts);
    }

    void add_parts(const Corners& c, const DVec3& normal, double area, int cuts) {
        if (cuts == 0) return add_part((c[0] + c[1] + c[2]) / 3.0, normal, area);
        const DVec3 ab = (c[0] + c[1]) / 2.0, bc = (c[1] + c[2]) / 2.0, ca = (c[2] + c[0]) / 2.0;
        for (const Corners& part : {Corners{c[0], ab, ca}, Corners{ab, c[1], bc},
                                    Corners{ca, bc, c[2]}, Corners{ab, bc, ca}})
            add_parts(part, normal, area / 4, cuts - 1);
    }

    void add_part(const DVec3& place, const DVec3& normal, double area) {
        int key = 0, steepest = 0;
        for (int c = 0; c < 3; ++c) {
            const double at = (within(place[c]) + 1) / 2 * kGrid;
            key = key * kGrid + std::min(static_cast<int>(at), kGrid - 1);
            if (std::abs(normal[c]) > std::abs(normal[steepest])) steepest = c;
        }
        Sums& sums = sums_[(key * 3 + steepest) * 2 + (normal[steepest] < 0 ? 1 : 0)];
        add_area(sums.area, whole_area(area));
        ++sums.count;
        for (int c = 0; c < 3; ++c) {
            sums.place[static_cast<std::size_t>(c)] += whole(within(place[c]), kUnit);
            sums.normal[static_cast<std::size_t>(c)] += whole(normal[c], kUnit);
        }
    }

    const geom::Mesh& mesh_;
    std::int64_t total_ = 0;
    std::map<int, Sums> sums_; // by place in the grid, and the way that it faces
};

// A lamp that stands still in the world, as its light's formula has it (scene/light.h).
struct Lamp {
    const scene::Light& light;
    DVec3 place, axis{0, 0, -1};
    double reach, nearest;

    Lamp(const scene::Light& of, const geom::Mesh& frame)
        : light(of), place(scene::radii_from_centre(frame, of.position)) {
        constexpr double kNearest = 0x1p-10;
        reach = std::max(length(place), 1.0);
        nearest = std::max(of.size * scene::radii_per_unit(frame), kNearest);
        const DVec3 target = of.target ? scene::radii_from_centre(frame, *of.target) : DVec3(0);
        axis = normalized(target - place, axis);
    }

    double at(const SurfaceCell& cell) const {
        const DVec3 way = place - cell.place;
        const double square = dot3(way, way);
        if (!(square > 0)) return 0;
        const DVec3 towards = way / scanout::sqrt(square);
        // A cell without a normal of its own is lit from anywhere.
        const double cosine = cell.normal == DVec3(0) ? 1 : std::abs(dot3(cell.normal, towards));
        return light.power * cosine * cone(-dot3(towards, axis)) * reach * reach /
               std::max(square, nearest * nearest);
    }

private:
    double cone(double cosine) const {
        if (light.kind != scene::LightKind::spot) return 1;
        const double outer = light.outer_degrees < 180 ? cos_degrees(light.outer_degrees) : -2;
        return cosine > outer ? 1 : 0; // its rim counts as its middle
    }
};

} // namespace

Surroundings surroundings_of(const geom::Mesh& mesh) {
    return {mesh.centre, mesh.exponent, mesh.radius, Collector(mesh).cells()};
}

double lamp_light(std::span<const scene::Light> lights, const Surroundings& surroundings,
                  int channel) {
    constexpr std::int64_t kShare = 100; // of the area may be brighter: one part in so many
    geom::Mesh frame;                    // all that places ask of a mesh
    frame.centre = surroundings.centre;
    frame.exponent = surroundings.exponent;
    frame.radius = surroundings.radius;
    std::vector<Lamp> lamps;
    for (const scene::Light& light : lights)
        if ((light.kind == scene::LightKind::point || light.kind == scene::LightKind::spot) &&
            light.frame == scene::LightFrame::world)
            lamps.emplace_back(light, frame);
    if (lamps.empty()) return 0;
    struct Lit {
        double light;
        std::int64_t area;
    };
    std::vector<Lit> lit;
    std::int64_t rest = 0;
    for (const SurfaceCell& cell : surroundings.cells) {
        double sum = 0;
        for (const Lamp& lamp : lamps)
            sum += lamp.at(cell) * double{lamp.light.colour[channel]};
        lit.push_back({sum, cell.area});
        add_area(rest, cell.area);
    }
    rest /= kShare;
    std::sort(lit.begin(), lit.end(), [](const Lit& a, const Lit& b) { return a.light > b.light; });
    for (const Lit& cell : lit) {
        rest -= cell.area;
        if (rest < 0) return cell.light;
    }
    return 0;
}

} // namespace scanout::frame
