// Image quilting (Efros and Freeman 2001): squares of the sample, row by row, each of those that
// fit what lies there already on a strip along its left and upper side, a sixth of it wide. It is
// cut along the path on which the two differ least.
#include "signal/candidates.h"
#include "signal/grow.h"
#include "signal/seam.h"

#include <algorithm>

namespace scanout::signal {
namespace {

class Quilt {
public:
    Quilt(const image::Image& sample, const Synthesis& how, Jobs& jobs)
        : sample_(sample), how_(how), side_(how.window), overlap_(std::max(side_ / 6, 1)),
          random_(how.seed),
          places_(sample, {0, 0, sample.width() - side_ + 1, sample.height() - side_ + 1}, jobs),
          out_(how.width, how.height) {}

    image::Image run(const Progress& progress) {
        const int step = side_ - overlap_;
        for (int y = 0; y == 0 || y + overlap_ < how_.height; y += step) {
            for (int x = 0; x == 0 || x + overlap_ < how_.width; x += step)
                lay(x, y);
            if (progress) progress(std::min(1.0, static_cast<double>(y + side_) / how_.height));
        }
        return std::move(out_);
    }

private:
    bool inside(int x, int y) const { return x < how_.width && y < how_.height; }

    void lay(int x0, int y0) {
        known_.clear();
        for (int dy = 0; dy < side_; ++dy)
            for (int dx = 0; dx < side_; ++dx) {
                const bool laid = (x0 > 0 && dx < overlap_) || (y0 > 0 && dy < overlap_);
                if (laid && inside(x0 + dx, y0 + dy))
                    known_.push_back({dx, dy, out_.at(x0 + dx, y0 + dy), 1});
            }
        const Place from = places_.draw(known_, random_);
        const std::vector<int> left = cut(x0, y0, from, false), top = cut(x0, y0, from, true);
        for (int dy = 0; dy < side_; ++dy)
            for (int dx = 0; dx < side_; ++dx) {
                const bool new_across = x0 == 0 || dx >= left[static_cast<std::size_t>(dy)];
                const bool new_down = y0 == 0 || dy >= top[static_cast<std::size_t>(dx)];
                if (new_across && new_down && inside(x0 + dx, y0 + dy))
                    out_.at(x0 + dx, y0 + dy) = sample_.at(from.x + dx, from.y + dy);
            }
    }

    // Along the left strip, or across it along the upper one: from which pixel on the new square
    // shows. Beyond the picture nothing costs anything.
    std::vector<int> cut(int x0, int y0, Place from, bool upper) const {
        std::vector<std::uint32_t> cost(static_cast<std::size_t>(side_ * overlap_), 0);
        for (int i = 0; i < side_; ++i)
            for (int k = 0; k < overlap_; ++k) {
                const int dx = upper ? i : k, dy = upper ? k : i;
                if (!inside(x0 + dx, y0 + dy)) continue;
                const image::Rgba8 &old = out_.at(x0 + dx, y0 + dy),
                                   &fresh = sample_.at(from.x + dx, from.y + dy);
                const int r = old.r - fresh.r, g = old.g - fresh.g, b = old.b - fresh.b;
                cost[static_cast<std::size_t>(i * overlap_ + k)] =
                    static_cast<std::uint32_t>(r * r + g * g + b * b);
            }
        return cheapest_path(std::move(cost), overlap_);
    }

    const image::Image& sample_;
    const Synthesis& how_;
    int side_, overlap_;
    Random random_;
    BestPlaces places_;
    image::Image out_;
    std::vector<Known> known_;
};

} // namespace

image::Image quilted(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                     const Progress& progress) {
    return Quilt(sample, how, jobs).run(progress);
}

} // namespace scanout::signal
