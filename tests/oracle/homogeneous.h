// The oracle of clipping: it never clips. A triangle's edges as linear functions of the pixel,
// straight from homogeneous vertices, whatever the sign of their w (Olano and Greer 1997;
// HARD-CASES 10). In double, or exact on whole numbers. An edge is computed from its lower vertex
// to its higher one, so two triangles that share it see the same bits: watertight.
#pragma once

#include "oracle/coverage.h"

#include <cmath>
#include <tuple>

namespace scanout::oracle {

// Pixels times w (y down), and w, the distance along the view axis; any sign.
template <class Number>
struct ClipPoint {
    Number x, y, w;
    auto key() const { return std::tie(y, x, w); }
};

template <class Number>
struct Line {
    Number a, b, c; // a x + b y + c
    Number at(Number x, Number y) const { return (a * x + b * y) + c; }
};

template <class Number>
Line<Number> line_through(const ClipPoint<Number>& p, const ClipPoint<Number>& q) {
    const bool turn = q.key() < p.key();
    const ClipPoint<Number>&s = turn ? q : p, &t = turn ? p : q;
    const Line<Number> l{s.y * t.w - s.w * t.y, s.w * t.x - s.x * t.w, s.x * t.y - s.y * t.x};
    return turn ? Line<Number>{-l.a, -l.b, -l.c} : l;
}

// Where a sample lies: certainly inside, certainly outside, or closer than asked to an edge or to
// the near plane's cut.
enum class Place { outside, inside, close };

template <class Number>
class HomogeneousTriangle {
public:
    // x, y of the vertices and of the samples may be in any unit; `unit` of them make a pixel.
    HomogeneousTriangle(const ClipPoint<Number>& a, const ClipPoint<Number>& b,
                        const ClipPoint<Number>& c, double near_w, double unit = 1)
        : near_w_(near_w),
          unit_(unit), edge_{line_through(b, c), line_through(c, a), line_through(a, b)} {
        const Number det = (edge_[0].a * a.x + edge_[0].b * a.y) + edge_[0].c * a.w;
        empty_ = det == Number(0);
        if (det < Number(0))
            for (Line<Number>& e : edge_)
                e = {-e.a, -e.b, -e.c};
        size_ = std::abs(static_cast<double>(det));
        for (const Line<Number>& e : edge_) { // sum of the three / det = 1 / w
            inverse_w_.a += static_cast<double>(e.a) / size_;
            inverse_w_.b += static_cast<double>(e.b) / size_;
            inverse_w_.c += static_cast<double>(e.c) / size_;
        }
    }

    double inverse_w(double x, double y) const { return inverse_w_.at(x, y); }
    // How much 1 / w changes along x and y together, per pixel.
    double inverse_w_slope() const {
        return (std::abs(inverse_w_.a) + std::abs(inverse_w_.b)) * unit_;
    }

    // near: how close to an edge or a cut (pixels) is too close to tell.
    Place place(Number x, Number y, double near) const {
        if (empty_) return Place::outside;
        bool inside = true, close = false;
        for (const Line<Number>& e : edge_) {
            const double d = distance(static_cast<double>(e.at(x, y)), static_cast<double>(e.a),
                                      static_cast<double>(e.b));
            if (d < -near) return Place::outside;
            inside = inside && d > 0;
            close = close || d < near;
        }
        const double cut =
            distance(1 / near_w_ - inverse_w_inside(x, y), inverse_w_.a, inverse_w_.b);
        if (cut < -near) return Place::outside;
        if (close || cut < near) return Place::close;
        return inside ? Place::inside : Place::outside;
    }
    bool empty() const { return empty_; }

private:
    // The same where all edges are positive: nothing cancels, whatever the vertices' distances.
    double inverse_w_inside(Number x, Number y) const {
        double sum = 0;
        for (const Line<Number>& e : edge_)
            sum += static_cast<double>(e.at(x, y)) / size_;
        return sum;
    }
    // From the value of a linear function to the distance from its zero, in pixels.
    double distance(double value, double a, double b) const {
        const double length = std::hypot(a, b);
        if (length == 0) return value > 0 ? HUGE_VAL : -HUGE_VAL;
        return value / length / unit_;
    }

    double near_w_, unit_;
    double size_; // det, positive
    bool empty_;
    std::array<Line<Number>, 3> edge_; // positive inside
    Line<double> inverse_w_{0, 0, 0};
};

} // namespace scanout::oracle
