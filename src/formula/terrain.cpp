// Terrain by midpoint displacement (Fournier, Fussell and Carpenter 1982): the middle of a square
// is the mean of its corners, moved by chance; then the middle of each side the mean of what is
// around it; then squares of half the side, which are moved less.
#include "formula/height_field.h"
#include "formula/makers.h"
#include "math/random.h"

#include <algorithm>
#include <bit>

namespace scanout::formula {
namespace {

constexpr double kRoughness = 0.53; // of each halving, of what the one before moved

class Displacement {
public:
    Displacement(const Wanted& wanted)
        : side_(static_cast<int>(std::bit_ceil(
              static_cast<unsigned>(std::max({wanted.width, wanted.height, 2}) - 1)))),
          grid_(side_ + 1, side_ + 1), seed_(wanted.seed) {
        for (const int y : {0, side_})
            for (const int x : {0, side_})
                grid_.at(x, y) = chance(x, y);
        double moved = 1;
        int octaves = wanted.detail;
        for (int step = side_; step > 1; step /= 2) {
            halve(step, octaves-- > 0 ? moved : 0);
            moved *= kRoughness;
        }
    }

    // Of the upper left corner of the grid, from 0 to 1.
    image::Plane heights(int width, int height) const {
        image::Plane out(width, height);
        double low = grid_.at(0, 0), high = low;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double h = out.at(x, y) = grid_.at(x, y);
                low = std::min(low, h);
                high = std::max(high, h);
            }
        for (double& h : out.value)
            h = high > low ? (h - low) / (high - low) : 0;
        return out;
    }

private:
    // In [-1, 1), of the place alone: no order of drawing decides.
    double chance(int x, int y) const {
        const auto place = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
        Random of_place(Random(seed_).next() ^ place * 0x9e3779b97f4a7c15U);
        return 2 * of_place.unit() - 1;
    }

    void halve(int step, double moved) {
        const int half = step / 2;
        for (int y = half; y < side_; y += step)
            for (int x = half; x < side_; x += step)
                grid_.at(x, y) = ((grid_.at(x - half, y - half) + grid_.at(x + half, y - half)) +
                                  (grid_.at(x - half, y + half) + grid_.at(x + half, y + half))) /
                                     4 +
                                 moved * chance(x, y);
        for (int y = 0; y <= side_; y += half)
            for (int x = (y / half) % 2 == 0 ? half : 0; x <= side_; x += step) {
                double sum = 0;
                int count = 0;
                const auto add = [&](int nx, int ny) {
                    if (nx < 0 || ny < 0 || nx > side_ || ny > side_) return;
                    sum += grid_.at(nx, ny);
                    ++count;
                };
                add(x, y - half);
                add(x - half, y);
                add(x + half, y);
                add(x, y + half);
                grid_.at(x, y) = sum / count + moved * chance(x, y);
            }
    }

    int side_;
    image::Plane grid_;
    std::uint64_t seed_;
};

image::Plane heights_of(const Wanted& wanted) {
    return Displacement(wanted).heights(wanted.width, wanted.height);
}

} // namespace

image::Image terrain_picture(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    const image::Plane heights = heights_of(wanted);
    if (progress) progress(0.9);
    image::Image out(wanted.width, wanted.height);
    for (std::size_t i = 0; i < heights.value.size(); ++i) {
        const auto code = static_cast<std::uint8_t>(255 * heights.value[i] + 0.5);
        out.pixels()[i] = {code, code, code, 255};
    }
    return out;
}

geom::PolygonMesh terrain_model(const Wanted& wanted, Jobs& /*jobs*/, const Progress& progress) {
    const image::Plane heights = heights_of(wanted);
    if (progress) progress(0.5);
    return surface_of(heights, 0.5);
}

} // namespace scanout::formula
