// Efros and Leung 1999: from a seed of 3 x 3 pixels of the sample the picture grows pixel by pixel,
// those with most neighbours first. A neighbour's weight falls off as a Gaussian whose width is
// the window's / 6.4, as theirs.
#include "base/check.h"
#include "math/transcendental.h"
#include "signal/candidates.h"
#include "signal/grow.h"

#include <algorithm>

namespace scanout::signal {
namespace {

class Growth {
public:
    Growth(const image::Image& sample, const Synthesis& how, Jobs& jobs)
        : sample_(sample), how_(how), half_(how.window / 2), random_(how.seed),
          places_(sample, {half_, half_, sample.width() - half_, sample.height() - half_}, jobs),
          out_(how.width, how.height), filled_(out_.pixels().size(), 0) {
        CHECK(how.window % 2 == 1);
        make_window();
    }

    image::Image run(const Progress& progress) {
        plant();
        while (left_ > 0) {
            for (const Place& place : next_layer()) {
                fill(place);
                if (progress && left_ % 64 == 0)
                    progress(1 - static_cast<double>(left_) / static_cast<double>(filled_.size()));
            }
        }
        return std::move(out_);
    }

private:
    bool filled(int x, int y) const {
        return x >= 0 && y >= 0 && x < how_.width && y < how_.height &&
               filled_[static_cast<std::size_t>(y) * static_cast<std::size_t>(how_.width) +
                       static_cast<std::size_t>(x)] != 0;
    }
    void put(int x, int y, image::Rgba8 colour) {
        out_.at(x, y) = colour;
        filled_[static_cast<std::size_t>(y) * static_cast<std::size_t>(how_.width) +
                static_cast<std::size_t>(x)] = 1;
        --left_;
    }

    // What counts of the window, the heaviest first; weights are whole numbers.
    void make_window() {
        const double sigma = how_.window / 6.4;
        for (int dy = -half_; dy <= half_; ++dy)
            for (int dx = -half_; dx <= half_; ++dx) {
                constexpr double kLog2E = 1.4426950408889634;
                const double fall = exp2(-kLog2E * (dx * dx + dy * dy) / (2 * sigma * sigma));
                const auto weight = static_cast<std::uint32_t>(1024 * fall + 0.5);
                if (weight > 0 && (dx != 0 || dy != 0)) window_.push_back({dx, dy, {}, weight});
            }
        std::stable_sort(window_.begin(), window_.end(),
                         [](const Known& a, const Known& b) { return a.weight > b.weight; });
    }

    // A piece of the sample in the middle.
    void plant() {
        left_ = filled_.size();
        const Place from{
            static_cast<int>(random_.below(static_cast<std::uint32_t>(sample_.width() - 2))),
            static_cast<int>(random_.below(static_cast<std::uint32_t>(sample_.height() - 2)))};
        for (int dy = 0; dy < 3; ++dy)
            for (int dx = 0; dx < 3; ++dx) {
                const int x = how_.width / 2 - 1 + dx, y = how_.height / 2 - 1 + dy;
                if (x >= 0 && y >= 0 && x < how_.width && y < how_.height)
                    put(x, y, sample_.at(from.x + dx, from.y + dy));
            }
    }

    // The pixels beside what is filled: those with most filled neighbours first, and equal ones in
    // an order that chance gives, so that no direction grows faster.
    std::vector<Place> next_layer() {
        struct Next {
            Place place;
            int neighbours;
            std::uint64_t chance;
        };
        std::vector<Next> layer;
        for (int y = 0; y < how_.height; ++y)
            for (int x = 0; x < how_.width; ++x) {
                if (filled(x, y)) continue;
                int neighbours = 0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        neighbours += filled(x + dx, y + dy) ? 1 : 0;
                if (neighbours > 0) layer.push_back({{x, y}, neighbours, random_.next()});
            }
        std::stable_sort(layer.begin(), layer.end(), [](const Next& a, const Next& b) {
            return a.neighbours != b.neighbours ? a.neighbours > b.neighbours : a.chance < b.chance;
        });
        std::vector<Place> places;
        places.reserve(layer.size());
        for (const Next& next : layer)
            places.push_back(next.place);
        return places;
    }

    void fill(const Place& place) {
        known_.clear();
        for (Known known : window_) {
            if (!filled(place.x + known.dx, place.y + known.dy)) continue;
            known.colour = out_.at(place.x + known.dx, place.y + known.dy);
            known_.push_back(known);
        }
        const Place from = places_.draw(known_, random_);
        put(place.x, place.y, sample_.at(from.x, from.y));
    }

    const image::Image& sample_;
    const Synthesis& how_;
    int half_;
    Random random_;
    BestPlaces places_;
    image::Image out_;
    std::vector<std::uint8_t> filled_;
    std::size_t left_ = 0;
    std::vector<Known> window_, known_;
};

} // namespace

image::Image grown_by_pixel(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                            const Progress& progress) {
    return Growth(sample, how, jobs).run(progress);
}

} // namespace scanout::signal
