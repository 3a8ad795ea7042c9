// A picture that was drawn smaller, brought to its full size: bilinear, between sRGB codes, which
// errs less than the same in linear light (docs/GUIDE.md has the figures). Whole numbers alone: the
// same bits everywhere.
#pragma once

#include "base/jobs.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace scanout::image {

// Places lie on a grid of 1/16 of a small pixel: exact for 1/2, 1/4 and 3/4 of the size, and 1/32
// off at most for others. Colours are weighted by alpha.
class Enlarger {
public:
    // `large` is no smaller than `small`, which has a pixel at least. Every pixel of it is written.
    void run(const Image& small, Image& large, Jobs& jobs);

private:
    // Between two neighbours: the second counts so many sixteenths. At the edge both are the same.
    struct Place {
        std::int32_t first = 0, second = 0;
        std::uint32_t weight = 0;
    };
    static Place place(int at, int small, int large);
    std::vector<Place> columns_;
    std::vector<std::vector<std::uint64_t>> rows_; // one a worker: two small ones, mixed
};

} // namespace scanout::image
