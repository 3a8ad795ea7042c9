#include "signal/candidates.h"

#include "base/check.h"

#include <algorithm>
#include <limits>

namespace scanout::signal {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

// A tenth above.
std::uint64_t tolerated(std::uint64_t least) {
    return least == kNone ? kNone : least + least / 10;
}

std::uint32_t squared_difference(const image::Rgba8& a, const image::Rgba8& b) {
    const int r = a.r - b.r, g = a.g - b.g, blue = a.b - b.b;
    return static_cast<std::uint32_t>(r * r + g * g + blue * blue);
}

} // namespace

BestPlaces::BestPlaces(const image::Image& sample, image::Rect within, Jobs& jobs)
    : sample_(sample), within_(within), jobs_(jobs),
      rows_(static_cast<std::size_t>(within.height())) {
    CHECK(!within.empty());
}

// Any number above the limit where it is above it: most places are given up after a few pixels.
BestPlaces::Distance BestPlaces::distance(const image::Rgba8* at, Distance limit) const {
    constexpr std::size_t kStep = 8;
    Distance sum = 0;
    for (std::size_t i = 0; i < steps_.size(); i += kStep) {
        const std::size_t end = std::min(i + kStep, steps_.size());
        for (std::size_t k = i; k < end; ++k)
            sum +=
                Distance{steps_[k].weight} * squared_difference(at[steps_[k].to], steps_[k].colour);
        if (sum > limit) return sum;
    }
    return sum;
}

// All that might be within the tolerance, which only shrinks.
void BestPlaces::search_row(int y, std::vector<Found>& row) const {
    row.clear();
    Distance least = kNone;
    for (int x = within_.x0; x < within_.x1; ++x) {
        const Distance d = distance(&sample_.at(x, y), tolerated(least));
        if (d > tolerated(least)) continue;
        least = std::min(least, d);
        row.push_back({{x, y}, d});
    }
}

Place BestPlaces::draw(std::span<const Known> known, Random& random) {
    steps_.clear();
    for (const Known& k : known)
        steps_.push_back({std::ptrdiff_t{k.dy} * sample_.width() + k.dx, k.colour, k.weight});
    jobs_.for_each(within_.height(), [&](int row, int /*worker*/) {
        search_row(within_.y0 + row, rows_[static_cast<std::size_t>(row)]);
    });
    Distance least = kNone;
    for (const std::vector<Found>& row : rows_)
        for (const Found& found : row)
            least = std::min(least, found.distance);
    fitting_.clear();
    for (const std::vector<Found>& row : rows_)
        for (const Found& found : row)
            if (found.distance <= tolerated(least)) fitting_.push_back(found.place);
    return fitting_[random.below(static_cast<std::uint32_t>(fitting_.size()))];
}

} // namespace scanout::signal
