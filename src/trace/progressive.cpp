#include "trace/progressive.h"

#include "math/transcendental.h"
#include "trace/lights.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

namespace scanout::trace {
namespace {

// Rows in an order whose beginnings are spread evenly over the picture: what is known early stands
// for the whole. The bits of their numbers are read backwards, as van der Corput's sequence does.
std::vector<int> spread_rows(int height) {
    std::vector<int> rows;
    int size = 1;
    while (size < height)
        size *= 2;
    for (int i = 0; i < size; ++i) {
        int row = 0;
        for (int bit = 1, weight = size / 2; bit < size; bit *= 2, weight /= 2)
            row += (i & bit) != 0 ? weight : 0;
        if (row < height) rows.push_back(row);
    }
    return rows;
}

} // namespace

Result<std::unique_ptr<Progressive>> Progressive::create(const scene::Scene& scene,
                                                         const scene::View& view, const Look& look,
                                                         const Effort& effort,
                                                         const std::atomic<bool>* cancelled) {
    const Tone tone = find_tone(look.tone);
    if (tone == nullptr) return fail(Exit::usage, "the reference has no tone curve {}", look.tone);
    for (const std::string& name : look.reflection)
        if (find_reflection(name) == nullptr)
            return fail(Exit::usage, "the reference has no reflection model {}", name);
    std::unique_ptr<Progressive> made(new Progressive(view, look, effort));
    TRY(World world, World::create(scene, made->view_, made->look_, cancelled));
    made->world_ = std::make_unique<World>(std::move(world));
    made->tracer_ = std::make_unique<Tracer>(
        *made->world_, made->look_, placed(look.lights, view, scene.mesh), tone, effort.seed);
    made->begin(effort.estimate_first ? Stage::estimate : Stage::settle);
    return made;
}

Progressive::Progressive(const scene::View& view, const Look& look, const Effort& effort)
    : view_(view), look_(look), most_samples_(effort.most_samples) {
    made_.image = image::Image(look.width, look.height);
    const std::size_t pixels = made_.image.pixels().size();
    made_.light.resize(pixels);
    made_.error.resize(pixels);
    samples_.resize(pixels);
    contrast_.resize(pixels);
    scatter_.resize(pixels);
    once_more_.resize(pixels);
    known_.resize(pixels);
}

std::uint64_t Progressive::bytes(int width, int height) {
    constexpr std::uint64_t kAPixel = sizeof(image::Rgba8) + sizeof(Vec3) + 4 * sizeof(float) +
                                      sizeof(std::uint32_t) + sizeof(Known) + sizeof(int);
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    return kAPixel * pixels + pixels / 8; // and a bit: once_more_
}

std::vector<int> Progressive::all_pixels() const {
    std::vector<int> all;
    all.reserve(known_.size());
    for (const int row : spread_rows(look_.height))
        for (int x = 0; x < look_.width; ++x)
            if (const int pixel = row * look_.width + x; known(pixel) != Known::final)
                all.push_back(pixel);
    return all;
}

void Progressive::add_beside(int pixel, std::vector<int>& out) {
    const int width = look_.width, height = look_.height, x = pixel % width, y = pixel / width;
    const auto hard = static_cast<std::size_t>(pixel);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
            const int beside = v * width + u;
            const auto i = static_cast<std::size_t>(beside);
            if (once_more_[i] || samples_[hard] < 8 * samples_[i] ||
                contrast_[hard] <= 2 * contrast_[i])
                continue;
            once_more_[i] = true;
            out.push_back(beside);
        }
}

// Of the whole picture first, then only of the round before: nothing else has changed since.
std::vector<int> Progressive::beside_hard_ones(Stage before) {
    std::vector<int> found;
    if (before == Stage::beside_hard_ones) {
        for (const int pixel : pixels_)
            add_beside(pixel, found);
        return found;
    }
    for (std::size_t i = 0; i < samples_.size(); ++i)
        if (samples_[i] >= 8 * kFewestSamples) add_beside(static_cast<int>(i), found);
    return found;
}

void Progressive::begin(Stage stage) {
    const Stage before = std::exchange(stage_, stage);
    if (stage == Stage::beside_hard_ones)
        pixels_ = beside_hard_ones(before);
    else if (stage != Stage::finished)
        pixels_ = all_pixels();
    else
        pixels_.clear();
    next_ = 0;
    if (stage != Stage::finished) return;
    made_.samples = std::accumulate(samples_.begin(), samples_.end(), std::uint64_t{0});
    made_.noise = noise();
}

// Most of it is that of pixels that got all the samples there are. The others stopped by their own
// estimates, and those that were put too low stopped first: so these count with their bounds.
double Progressive::noise() const {
    Scatter of_hard_ones;
    double squares = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (samples_[i] < most_samples_) {
            const double error = double{made_.error[i]} / kMargin;
            squares += error * error;
        } else {
            of_hard_ones.of_parts += double{scatter_[i][0]};
            of_hard_ones.of_halves += double{scatter_[i][1]};
        }
    }
    squares += square_of_error(of_hard_ones);
    return samples_.empty() ? 0 : scanout::sqrt(squares / static_cast<double>(samples_.size()));
}

void Progressive::step(Jobs& jobs, Time until) {
    begun_.resize(
        static_cast<std::size_t>(std::max(jobs.threads(), static_cast<int>(begun_.size()))));
    while (!finished()) {
        const std::uint32_t most = stage_ == Stage::estimate ? kFewestSamples : most_samples_;
        const std::uint32_t fewest = stage_ == Stage::beside_hard_ones
                                         ? std::min(kSamplesOnceMore, most_samples_)
                                         : kFewestSamples;
        const int count = static_cast<int>(pixels_.size());
        std::atomic<bool> late = false;
        jobs.for_each(static_cast<int>(begun_.size()), [&](int job, int) {
            std::optional<PixelSamples>& pixel = begun_[static_cast<std::size_t>(job)];
            for (;;) {
                if (!pixel) {
                    if (next_.load(std::memory_order_relaxed) >= count) return;
                    const int place = next_.fetch_add(1, std::memory_order_relaxed);
                    if (place >= count) return;
                    const int number = pixels_[static_cast<std::size_t>(place)];
                    pixel.emplace();
                    pixel->x = number % look_.width;
                    pixel->y = number / look_.width;
                    pixel->wanted = fewest;
                }
                if (!tracer_->advance(*pixel, most, until)) {
                    late = true;
                    return;
                }
                put(*pixel);
                pixel.reset();
            }
        });
        if (late) return;
        // What was traced once more may be hard, too.
        const bool again = stage_ == Stage::beside_hard_ones && !pixels_.empty();
        begin(again ? stage_ : static_cast<Stage>(static_cast<int>(stage_) + 1));
        if (std::chrono::steady_clock::now() >= until) return;
    }
}

void Progressive::put(const PixelSamples& samples) {
    const TracedPixel traced = tracer_->pixel(samples);
    const auto i = static_cast<std::size_t>(samples.y * look_.width + samples.x);
    made_.image.pixels()[i] = traced.code;
    made_.light[i] = Vec3(traced.light);
    made_.error[i] = static_cast<float>(traced.error);
    samples_[i] = traced.samples;
    contrast_[i] = static_cast<float>(traced.contrast);
    scatter_[i] = {static_cast<float>(traced.scatter.of_parts),
                   static_cast<float>(traced.scatter.of_halves)};
    const bool is_final =
        stage_ != Stage::estimate || traced.error < kErrorWanted || most_samples_ <= kFewestSamples;
    if (is_final && known_[i] != Known::final) final_.fetch_add(1, std::memory_order_relaxed);
    known_[i] = is_final ? Known::final : std::max(known_[i], Known::estimate);
}

double Progressive::share() const {
    constexpr double kOnceMore = 0.1; // of the work, about: the last stage
    if (finished()) return 1;
    const auto of = [](double part, std::size_t all) {
        return part / static_cast<double>(std::max<std::size_t>(all, 1));
    };
    const double first = of(final_, known_.size());
    const double last =
        stage_ == Stage::beside_hard_ones
            ? of(std::min(next_.load(), static_cast<int>(pixels_.size())), pixels_.size())
            : 0;
    return (1 - kOnceMore) * first + kOnceMore * last;
}

} // namespace scanout::trace
