// Rays against triangles, in double, one by one: the oracle of shadows. Nothing of the renderer.
// Möller and Trumbore 1997.
#pragma once

#include "math/vec.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace scanout::oracle {

struct Ray {
    DVec3 from, way;
};

struct Triangles {
    std::vector<std::array<DVec3, 3>> corner;

    // The ray's parameter where it meets a triangle; infinity where it does not.
    double meets(const Ray& ray, std::size_t i) const {
        const auto& [a, b, c] = corner[i];
        const DVec3 ab = b - a, ac = c - a, p = cross3(ray.way, ac);
        const double det = dot3(ab, p);
        if (det == 0) return std::numeric_limits<double>::infinity();
        const DVec3 s = ray.from - a, q = cross3(s, ab);
        const double u = dot3(s, p) / det, v = dot3(ray.way, q) / det;
        if (u < 0 || v < 0 || u + v > 1) return std::numeric_limits<double>::infinity();
        return dot3(ac, q) / det;
    }
    struct Hit {
        double t = std::numeric_limits<double>::infinity();
        std::size_t triangle = SIZE_MAX;
        bool any() const { return triangle != SIZE_MAX; }
    };
    Hit first(const Ray& ray, double least) const {
        Hit found;
        for (std::size_t i = 0; i < corner.size(); ++i) {
            const double t = meets(ray, i);
            if (t > least && t < found.t) found = {t, i};
        }
        return found;
    }
    // Does any but `except` stand between the two parameters?
    bool blocks(const Ray& ray, double least, double most, std::size_t except) const {
        for (std::size_t i = 0; i < corner.size(); ++i) {
            if (i == except) continue;
            const double t = meets(ray, i);
            if (t > least && t < most) return true;
        }
        return false;
    }
    DVec3 normal(std::size_t i) const {
        const DVec3 n = cross3(corner[i][1] - corner[i][0], corner[i][2] - corner[i][0]);
        return n / std::sqrt(dot3(n, n));
    }
};

} // namespace scanout::oracle
