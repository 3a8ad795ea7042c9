#include "trace/render.h"

#include "math/srgb.h"
#include "math/transcendental.h"
#include "trace/display.h"
#include "trace/lights.h"
#include "trace/sampler.h"
#include "trace/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace scanout::trace {
namespace {

// What one ray sees: light, and how much of the background shows beside it.
struct Sample {
    DVec3 light{0};
    double transmittance = 1;
};

// Sums of samples, weighted by the filter.
struct Sum {
    Sample sum{DVec3(0), 0};
    double weight = 0;
    void add(const Sample& s, double w) {
        sum.light = sum.light + s.light * w;
        sum.transmittance += s.transmittance * w;
        weight += w;
    }
    void add(const Sum& other) {
        sum.light = sum.light + other.sum.light;
        sum.transmittance += other.sum.transmittance;
        weight += other.weight;
    }
};

class Tracer {
public:
    Tracer(const World& world, const Look& look, PlacedLights lights, Tone tone,
           const Effort& effort)
        : world_(world), look_(look), lights_(std::move(lights)), tone_(tone), effort_(effort),
          least_(world.bvh().radius() * 0x1p-34),
          background_(srgb_decode(look.background.r), srgb_decode(look.background.g),
                      srgb_decode(look.background.b)) {}

    struct Pixel {
        DVec3 light;
        image::Rgba8 code;
        double error; // codes
        std::uint32_t samples;
    };
    // Of at least so many samples, which the effort allows.
    Pixel pixel(int x, int y, std::uint32_t fewest) const;

private:
    static constexpr std::size_t kParts = 4;
    struct Mean {
        DVec3 light;
        double alpha; // 0 to 1
    };
    Mean mean(const Sum& sum) const;
    Sample trace(const Ray& ray, std::uint32_t index, std::uint32_t seed) const;
    DVec3 shown(const Hit& hit, const Ray& ray, std::uint32_t index, std::uint32_t seed) const;
    double lit_share(const PlacedLight& light, int number, const DVec3& place, const DVec3& facing,
                     std::uint32_t triangle, std::uint32_t index, std::uint32_t seed) const;
    bool in_shadow(const Ray& ray, double end, std::uint32_t triangle) const;
    double deviation(const std::array<Sum, kParts>& parts) const;
    double least_error(const std::array<Sum, kParts>& parts, const DVec3& range,
                       std::uint32_t count) const;

    const World& world_;
    const Look& look_;
    PlacedLights lights_;
    Tone tone_;
    Effort effort_;
    double least_; // parameter of shadow rays: nearer is the surface itself
    DVec3 background_;
};

bool Tracer::in_shadow(const Ray& ray, double end, std::uint32_t triangle) const {
    const double least = least_ / scanout::sqrt(dot3(ray.way, ray.way));
    if (!world_.has_holes())
        return world_.bvh().blocked(ray, least, end, triangle, world_.casters());
    for (Hit hit{least, kNothing, {}};;) {
        hit = world_.bvh().next(ray, hit);
        if (!hit.any() || hit.t >= end) return false;
        if (hit.triangle != triangle && world_.casters()[hit.triangle] != 0 &&
            !world_.lets_through(hit))
            return true;
    }
}

// Of a light with a size, by several points of it: what reaches a place is summed before the tone
// curve bends it. Points below the face's plane are not asked: the reflection model, which takes
// the light's middle, has counted already that they do not shine here. facing: the face's own
// normal, on the side that is seen.
double Tracer::lit_share(const PlacedLight& light, int number, const DVec3& place,
                         const DVec3& facing, std::uint32_t triangle, std::uint32_t index,
                         std::uint32_t seed) const {
    if (!light.has_size())
        return in_shadow(light.towards(place, DVec2(0.5)), light.end(), triangle) ? 0 : 1;
    constexpr std::uint32_t kPoints = 16;
    int above = 0, lit = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const Ray ray = light.towards(place, stratified(index * kPoints + i, number + 1, seed));
        if (dot3(ray.way, facing) <= 0) continue;
        ++above;
        lit += in_shadow(ray, light.end(), triangle) ? 0 : 1;
    }
    return above > 0 ? static_cast<double>(lit) / above : 0;
}

// What a surface shows to the eye, after the tone curve.
DVec3 Tracer::shown(const Hit& hit, const Ray& ray, std::uint32_t index, std::uint32_t seed) const {
    const DVec3 place = ray.from + ray.way * hit.t, eye = unit_of(-ray.way);
    const Surface surface = world_.surface(hit, ray);
    const DVec3 facing = world_.facing(hit, ray);
    std::array<Arrival, scene::kMaxLights> arrivals;
    std::size_t count = 0;
    for (std::size_t k = 0; k < lights_.others.size(); ++k) {
        const PlacedLight& light = lights_.others[k];
        Arrival arrival = light.at(place);
        if (arrival.colour == DVec3(0)) continue;
        if (look_.shadows && light.casts()) {
            const double share =
                lit_share(light, static_cast<int>(k), place, facing, hit.triangle, index, seed);
            if (share == 0) continue;
            arrival.colour = arrival.colour * share;
        }
        arrivals[count++] = arrival;
    }
    const DVec3 light =
        (world_.reflection(hit)(surface, eye, lights_.ambient, std::span(arrivals).first(count)) +
         world_.emission(hit)) *
        look_.exposure;
    DVec3 toned;
    for (int c = 0; c < 3; ++c)
        toned[c] = tone_(light[c], look_.white);
    return toned;
}

// Surfaces in the order in which they are met, until one hides the rest: Porter and Duff 1984.
Sample Tracer::trace(const Ray& ray, std::uint32_t index, std::uint32_t seed) const {
    Sample seen;
    for (Hit hit{world_.nearest(), kNothing, {}}; seen.transmittance > 0;) {
        hit = world_.bvh().next(ray, hit);
        if (!hit.any()) break;
        if (world_.is_left_out(hit.triangle)) continue;
        const double alpha = world_.alpha(hit);
        if (alpha <= 0) continue;
        seen.light = seen.light + shown(hit, ray, index, seed) * (seen.transmittance * alpha);
        seen.transmittance *= 1 - alpha;
    }
    return seen;
}

// Over the background. Light is that of what covers the pixel, where the background is clear.
Tracer::Mean Tracer::mean(const Sum& sum) const {
    const double back = sum.sum.transmittance / sum.weight, back_alpha = look_.background.a / 255.0;
    const double alpha = 1 - back * (1 - back_alpha);
    const DVec3 light = sum.sum.light / sum.weight + background_ * (back * back_alpha);
    return {alpha > 0 ? light / alpha : DVec3(0), alpha};
}

// The greatest standard deviation of a channel among the parts' means, codes.
double Tracer::deviation(const std::array<Sum, kParts>& parts) const {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        std::array<double, kParts> code;
        double middle = 0;
        for (std::size_t p = 0; p < kParts; ++p) {
            code[p] = parts[p].weight > 0 ? code_of(mean(parts[p]).light[c]) : 0;
            middle += code[p] / kParts;
        }
        double square = 0;
        for (const double value : code)
            square += (value - middle) * (value - middle) / (kParts - 1);
        worst = std::max(worst, scanout::sqrt(square));
    }
    return worst;
}

// Parts may agree by chance, as stratified sets do that an edge divides: an edge through the pixel
// leaves them about 0.3 N^-3/4 of what differs there, codes.
double Tracer::least_error(const std::array<Sum, kParts>& parts, const DVec3& range,
                           std::uint32_t count) const {
    Sum all;
    for (const Sum& part : parts)
        all.add(part);
    const DVec3 light = mean(all).light;
    const double root = scanout::sqrt(static_cast<double>(count));
    const double share = 0.3 / (root * scanout::sqrt(root));
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        worst = std::max(worst, code_of(light[c] + range[c] * share) - code_of(light[c]));
    return worst;
}

Tracer::Pixel Tracer::pixel(int x, int y, std::uint32_t fewest) const {
    const std::uint32_t seed = seed_of_pixel(x, y);
    std::array<Sum, kParts> parts{};
    DVec3 low(INFINITY), high(-INFINITY); // of the samples
    const auto take = [&](std::uint32_t index, Sum& part) {
        DVec2 at = stratified(index, 0, seed);
        double weight = 1;
        if (look_.filter) { // three pixels wide
            at = at * 3.0 - DVec2(1);
            weight = look_.filter(std::abs(at.x - 0.5)) * look_.filter(std::abs(at.y - 0.5));
        }
        const Sample sample = trace(world_.ray(x + at.x, y + at.y), index, seed);
        const DVec3 whole = sample.light + background_ * sample.transmittance;
        low = glm::min(low, whole);
        high = glm::max(high, whole);
        part.add(sample, weight);
    };
    std::uint32_t count = fewest;
    for (std::uint32_t i = 0; i < count; ++i)
        take(i, parts[i / (count / kParts)]);
    double error = 0;
    for (;;) {
        error = std::max(0.75 * deviation(parts), least_error(parts, high - low, count));
        if (error < kErrorWanted || count >= effort_.most_samples) break;
        // Twice as many: the parts that there are become two.
        parts[0].add(parts[1]);
        parts[1] = parts[2];
        parts[1].add(parts[3]);
        parts[2] = parts[3] = Sum();
        for (std::uint32_t i = 0; i < count; ++i)
            take(count + i, parts[2 + i / (count / 2)]);
        count *= 2;
    }
    Sum all;
    for (const Sum& part : parts)
        all.add(part);
    const Mean whole = mean(all);
    const auto code = [&](int c) {
        return static_cast<std::uint8_t>(code_of(whole.light[c]) + 0.5);
    };
    return {whole.light,
            {code(0), code(1), code(2), static_cast<std::uint8_t>(255 * whole.alpha)},
            error,
            count};
}

struct Canvas {
    int width, height;
    Reference made;
    std::vector<std::uint32_t> samples; // of each pixel

    Canvas(int w, int h) : width(w), height(h) {
        made.image = image::Image(w, h);
        const std::size_t pixels = made.image.pixels().size();
        made.light.resize(pixels);
        made.error.resize(pixels);
        samples.resize(pixels);
    }
    void put(int pixel, const Tracer::Pixel& p) {
        const auto i = static_cast<std::size_t>(pixel);
        made.image.pixels()[i] = p.code;
        made.light[i] = Vec3(p.light);
        made.error[i] = static_cast<float>(p.error);
        samples[i] = p.samples;
    }
    // Few samples of a pixel may all miss what a neighbour shows much of: the thin end of a
    // penumbra, the tip of a triangle.
    std::vector<int> beside_hard_ones() const {
        std::vector<int> found;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (most_about(x, y) >= 8 * samples[place(x, y)])
                    found.push_back(static_cast<int>(place(x, y)));
        return found;
    }

private:
    std::size_t place(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
    std::uint32_t most_about(int x, int y) const {
        std::uint32_t most = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                most = std::max(most, samples[place(u, v)]);
        return most;
    }
};

} // namespace

double Reference::mean_error() const {
    double sum = 0;
    for (const float e : error)
        sum += double{e} * double{e};
    return error.empty() ? 0 : scanout::sqrt(sum / static_cast<double>(error.size()));
}

std::size_t Reference::unsure() const {
    return static_cast<std::size_t>(
        std::count_if(error.begin(), error.end(), [](float e) { return e >= kErrorWanted; }));
}

Result<Reference> render(const scene::Scene& scene, const scene::View& view, const Look& look,
                         Jobs& jobs, const std::function<void(double)>& progress,
                         const Effort& effort) {
    const Tone tone = find_tone(look.tone);
    if (tone == nullptr) return fail(Exit::usage, "the reference has no tone curve {}", look.tone);
    for (const std::string& name : look.reflection)
        if (find_reflection(name) == nullptr)
            return fail(Exit::usage, "the reference has no reflection model {}", name);
    TRY(const World world, World::create(scene, view, look));
    const Tracer tracer(world, look, placed(look.lights, view, scene.mesh), tone, effort);
    Canvas canvas(look.width, look.height);
    const auto draw = [&](const std::vector<int>& pixels, std::uint32_t fewest, double from,
                          double to) {
        constexpr int kPixelsAJob = 16, kJobsAStep = 256;
        const int count = static_cast<int>(pixels.size());
        for (int first = 0; first < count; first += kPixelsAJob * kJobsAStep) {
            if (progress) progress(from + (to - from) * first / count);
            const int jobs_left = (count - first + kPixelsAJob - 1) / kPixelsAJob;
            jobs.for_each(std::min(kJobsAStep, jobs_left), [&](int job, int) {
                const int begin = first + job * kPixelsAJob;
                for (int i = begin; i < std::min(begin + kPixelsAJob, count); ++i) {
                    const int pixel = pixels[static_cast<std::size_t>(i)];
                    canvas.put(pixel, tracer.pixel(pixel % look.width, pixel / look.width, fewest));
                }
            });
        }
    };
    std::vector<int> all(canvas.made.light.size());
    std::iota(all.begin(), all.end(), 0);
    draw(all, kFewestSamples, 0, 0.9);
    draw(canvas.beside_hard_ones(), std::min(1024U, effort.most_samples), 0.9, 1);
    for (const std::uint32_t count : canvas.samples)
        canvas.made.samples += count;
    return std::move(canvas.made);
}

} // namespace scanout::trace
