// The places of a sample that fit best: the search that both ways of synthesis repeat.
#pragma once

#include "base/jobs.h"
#include "image/image.h"
#include "math/random.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::signal {

// One known pixel: where it stands from a candidate's place, its colour, how much it counts.
struct Known {
    int dx = 0, dy = 0;
    image::Rgba8 colour;
    std::uint32_t weight = 1;
};

struct Place {
    int x = 0, y = 0;
};

// Draws one of the places in `within` whose distance, the weighted sum of squared differences of
// codes, is no more than a tenth above the least. Known pixels that count most stand first. Every
// known pixel of every place lies in the sample.
class BestPlaces {
public:
    BestPlaces(const image::Image& sample, image::Rect within, Jobs& jobs);
    Place draw(std::span<const Known> known, Random& random);

private:
    using Distance = std::uint64_t;
    // A known pixel by its place in memory: from a candidate's.
    struct Step {
        std::ptrdiff_t to = 0;
        image::Rgba8 colour;
        std::uint32_t weight = 1;
    };
    struct Found {
        Place place;
        Distance distance = 0;
    };
    Distance distance(const image::Rgba8* at, Distance limit) const;
    void search_row(int y, std::vector<Found>& row) const;

    const image::Image& sample_;
    image::Rect within_;
    Jobs& jobs_;
    std::vector<Step> steps_;
    std::vector<std::vector<Found>> rows_; // of each row of places
    std::vector<Place> fitting_;
};

} // namespace scanout::signal
