#include "geom/ruler.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scanout::geom {
namespace {

// Powers of ten up to 22 are doubles, so that a step is the nearest double to
// its decimal number.
double power_of_ten(int exponent) {
    double power = 1;
    for (int i = 0; i < std::abs(exponent); ++i)
        power *= 10;
    return exponent < 0 ? 1 / power : power;
}

Vec3 normalised(const Mesh& mesh, const DVec3& file) {
    const double unit = std::ldexp(1.0, -mesh.exponent);
    const DVec3 p = (file - mesh.centre) * unit;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

std::uint32_t add_vertex(Mesh& out, const Vec3& position) {
    out.position.push_back(position);
    return static_cast<std::uint32_t>(out.position.size() - 1);
}

void add_line(Mesh& out, const Vec3& from, const Vec3& to) {
    CHECK(out.line_faces.list.empty());
    const std::uint32_t first = add_vertex(out, from);
    out.line_index.push_back(first);
    out.line_index.push_back(add_vertex(out, to));
}

// The vertices of faces in the order of their keys, each key once.
template <class Key>
std::vector<std::uint32_t> distinct(const Mesh& mesh, const Key& key) {
    std::vector<std::uint32_t> out = mesh.index;
    std::sort(out.begin(), out.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key(a) < key(b) || (key(a) == key(b) && a < b);
    });
    out.erase(std::unique(out.begin(), out.end(),
                          [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); }),
              out.end());
    return out;
}

DVec3 size_of(const Mesh& mesh) {
    return mesh.box_max - mesh.box_min;
}

} // namespace

double round_step(double x) {
    int exponent = 0;
    while (power_of_ten(exponent) > x)
        --exponent;
    while (power_of_ten(exponent + 1) <= x)
        ++exponent;
    for (const int digit : {5, 2})
        // 5 / 100, not 5 * 0.01: the nearest double.
        if (const double step =
                exponent < 0 ? digit / power_of_ten(-exponent) : digit * power_of_ten(exponent);
            step <= x)
            return step;
    return power_of_ten(exponent);
}

double grid_spacing(const DVec3& box_size) {
    const double longest = std::max({box_size.x, box_size.y, box_size.z});
    return round_step(longest > 0 ? longest / 8 : 1);
}

void add_box_lines(const Mesh& mesh, Mesh& out) {
    const auto corner = [&](int i) {
        return normalised(mesh, {(i & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                                 (i & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                                 (i & 4) != 0 ? mesh.box_max.z : mesh.box_min.z});
    };
    for (int i = 0; i < 8; ++i)
        for (int axis = 1; axis < 8; axis *= 2)
            if ((i & axis) == 0) add_line(out, corner(i), corner(i | axis));
}

void add_grid_lines(const Mesh& mesh, const AxisDirection& up, Mesh& out) {
    constexpr int kMargin = 2; // squares
    const double spacing = grid_spacing(size_of(mesh));
    const int across[2] = {(up.axis + 1) % 3, (up.axis + 2) % 3};
    double first[2], last[2];
    for (int k = 0; k < 2; ++k) {
        first[k] = std::floor(mesh.box_min[across[k]] / spacing) - kMargin;
        last[k] = std::ceil(mesh.box_max[across[k]] / spacing) + kMargin;
    }
    const auto at = [&](double a, double b) {
        DVec3 file(0);
        file[up.axis] = up.down ? mesh.box_max[up.axis] : mesh.box_min[up.axis];
        file[across[0]] = a * spacing;
        file[across[1]] = b * spacing;
        return normalised(mesh, file);
    };
    // A box of no size far from the origin may have fewer doubles than squares.
    constexpr double kMost = 1024;
    if (!(last[0] - first[0] < kMost) || !(last[1] - first[1] < kMost)) return;
    for (double a = first[0]; a <= last[0]; ++a)
        add_line(out, at(a, first[1]), at(a, last[1]));
    for (double b = first[1]; b <= last[1]; ++b)
        add_line(out, at(first[0], b), at(last[0], b));
}

void add_axis_line(const Mesh& mesh, int axis, Mesh& out) {
    constexpr double kLength = 0.5; // bounding radii
    DVec3 end = mesh.box_min;
    end[axis] += std::ldexp(kLength * mesh.radius, mesh.exponent);
    add_line(out, normalised(mesh, mesh.box_min), normalised(mesh, end));
}

void add_normal_lines(const Mesh& mesh, Mesh& out) {
    const auto key = [&](std::uint32_t v) {
        const Vec3 &p = mesh.position[v], &n = mesh.normal[v];
        return std::tie(p.x, p.y, p.z, n.x, n.y, n.z);
    };
    const auto length = static_cast<float>(kNormalLength * mesh.radius);
    for (const std::uint32_t v : distinct(mesh, key))
        add_line(out, mesh.position[v], mesh.position[v] + length * mesh.normal[v]);
}

void add_vertex_points(const Mesh& mesh, Mesh& out) {
    const auto key = [&](std::uint32_t v) {
        const Vec3& p = mesh.position[v];
        return std::tie(p.x, p.y, p.z);
    };
    for (const std::uint32_t v : distinct(mesh, key))
        out.point_index.push_back(add_vertex(out, mesh.position[v]));
}

} // namespace scanout::geom
