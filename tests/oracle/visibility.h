// The oracle of a whole scene: at a sample, which triangle is nearest, by watertight edge functions
// in double for every triangle (homogeneous.h). It tells when it cannot tell: where the renderer's
// snapping by half of 1/256 pixel may move an edge over the sample or swap two depths.
#pragma once

#include "oracle/homogeneous.h"

#include <optional>
#include <vector>

namespace scanout::oracle {

inline constexpr std::uint32_t kNothing = 0xffffffff;

class ExactScene {
public:
    explicit ExactScene(double near_w) : near_w_(near_w) {}

    // The triangle's id is its number.
    void add(const ClipPoint<double>& a, const ClipPoint<double>& b, const ClipPoint<double>& c) {
        triangle_.emplace_back(a, b, c, near_w_);
    }
    // The id of what is seen at the sample (pixels); nothing when it is too close to tell.
    std::optional<std::uint32_t> seen(double x, double y) const {
        constexpr double kSnap = 1.0 / 128; // pixels: twice what two snapped ends can do
        double best = 0, best_slack = 0, rival = 0;
        std::uint32_t id = kNothing;
        for (std::size_t i = 0; i < triangle_.size(); ++i) {
            const HomogeneousTriangle<double>& t = triangle_[i];
            const Place place = t.place(x, y, kSnap);
            if (place == Place::outside) continue;
            const double depth = t.inverse_w(x, y);
            const double slack = t.inverse_w_slope() * kSnap + std::abs(depth) * 1e-6;
            if (place == Place::inside && depth > best) {
                rival = std::max(rival, best + best_slack);
                best = depth;
                best_slack = slack;
                id = static_cast<std::uint32_t>(i);
            } else {
                rival = std::max(rival, depth + slack);
            }
        }
        if (rival > 0 && rival >= best - best_slack) return std::nullopt;
        return id;
    }

private:
    double near_w_;
    std::vector<HomogeneousTriangle<double>> triangle_;
};

} // namespace scanout::oracle
