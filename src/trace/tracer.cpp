#include "trace/tracer.h"

#include "math/srgb.h"
#include "math/transcendental.h"
#include "trace/render.h"
#include "trace/sampler.h"

#include <algorithm>
#include <span>
#include <utility>

namespace scanout::trace {

constexpr std::uint32_t kLightPoints = 16; // of a light with a size, for each sample

Tracer::Tracer(const World& world, const Look& look, PlacedLights lights, Tone tone, int seed)
    : world_(world), shadows_(world), occlusion_(world, look.occlusion_radius), look_(look),
      lights_(std::move(lights)), tone_(tone), seed_(seed),
      background_(srgb_decode(look.background.r), srgb_decode(look.background.g),
                  srgb_decode(look.background.b)) {}

// Of a light with a size, by several points of it: what reaches a place is summed before the tone
// curve bends it. Points below the ground's plane are not asked: the reflection model, which takes
// the light's middle, has counted already that they do not shine here.
double Tracer::lit_share(const PlacedLight& light, int number, const Ground& ground,
                         std::uint32_t triangle, std::uint32_t index, std::uint32_t seed) const {
    const auto& [place, facing] = ground;
    if (!light.has_size())
        return shadows_.blocked(light.towards(place, DVec2(0.5)), light.end(), triangle) ? 0 : 1;
    int above = 0, lit = 0;
    for (std::uint32_t i = 0; i < kLightPoints; ++i) {
        const Ray ray =
            light.towards(place, stratified(index * kLightPoints + i, number + 1, seed));
        if (dot3(ray.way, facing) <= 0) continue;
        ++above;
        lit += shadows_.blocked(ray, light.end(), triangle) ? 0 : 1;
    }
    return above > 0 ? static_cast<double>(lit) / above : 0;
}

// What a surface shows to the eye, after the tone curve.
Sample Tracer::shown(const Hit& hit, const Ray& ray, std::uint32_t index,
                     std::uint32_t seed) const {
    Sample seen;
    const DVec3 place = ray.from + ray.way * hit.t, eye = unit_of(-ray.way);
    const Surface surface = world_.surface(hit, ray);
    std::array<Arrival, scene::kMaxLights> arrivals;
    std::size_t count = 0;
    const Reflection reflection = world_.reflection(hit);
    for (std::size_t k = 0; k < lights_.others.size(); ++k) {
        const PlacedLight& light = lights_.others[k];
        Arrival arrival = light.at(place);
        if (arrival.colour == DVec3(0)) continue;
        if (look_.shadows && light.casts()) {
            const double share =
                lit_share(light, static_cast<int>(k), world_.ground(hit, ray, arrival.towards),
                          hit.triangle, index, seed);
            if (share == 0) continue;
            if (share != 1)
                seen.in_doubt =
                    seen.in_doubt + reflection(surface, eye, DVec3(0), std::span(&arrival, 1)) *
                                        (look_.exposure / kLightPoints);
            arrival.colour = arrival.colour * share;
        }
        arrivals[count++] = arrival;
    }
    DVec3 ambient = lights_.ambient_on(surface.normal);
    if (occlusion_.any() && ambient != DVec3(0) && !world_.is_blended(hit.triangle))
        ambient = ambient *
                  occlusion_.open(hit, ray, index, static_cast<int>(lights_.others.size()), seed);
    const bool unlit = world_.is_unlit(hit);
    if (unlit) seen.in_doubt = DVec3(0);
    const DVec3 reflected =
        unlit ? surface.albedo
              : reflection(surface, eye, ambient, std::span(arrivals).first(count));
    const DVec3 light = (reflected + world_.emission(hit)) * look_.exposure;
    for (int c = 0; c < 3; ++c)
        seen.light[c] = tone_(light[c], look_.white);
    return seen;
}

// Surfaces in the order in which they are met, until one hides the rest: Porter and Duff 1984.
Sample Tracer::trace(const Ray& ray, std::uint32_t index, std::uint32_t seed) const {
    Sample seen;
    for (Hit hit{world_.nearest(), kNothing, {}}; seen.transmittance > 0;) {
        hit = world_.next(ray, hit);
        if (!hit.any()) break;
        if (world_.is_left_out(hit.triangle)) continue;
        const double alpha = world_.alpha(hit);
        if (alpha <= 0) continue;
        const Sample here = shown(hit, ray, index, seed);
        seen.light = seen.light + here.light * (seen.transmittance * alpha);
        seen.in_doubt = seen.in_doubt + here.in_doubt * (seen.transmittance * alpha);
        seen.transmittance *= 1 - alpha;
    }
    return seen;
}

// Over the background. Light is that of what covers the pixel, where the background is clear.
Tracer::Mean Tracer::mean(const SampleSum& sum) const {
    const double back = sum.transmittance / sum.weight, back_alpha = look_.background.a / 255.0;
    const double alpha = 1 - back * (1 - back_alpha);
    const DVec3 light = sum.light / sum.weight + background_ * (back * back_alpha);
    return {alpha > 0 ? light / alpha : DVec3(0), alpha};
}

// Of the worst channel, codes.
void Tracer::estimate_error(PixelSamples& pixel) const {
    pixel.error = 0;
    pixel.scatter = {};
    const double back_alpha = look_.background.a / 255.0;
    SampleSum all;
    for (const SampleSum& part : pixel.parts)
        all.add(part);
    const Mean whole = mean(all);
    if (!(whole.alpha > 0)) return;
    // Parts may agree by chance: what divides the range that the samples saw may lie between two of
    // them, which a filter spreads over nine pixels; or between two points of a light.
    const double hidden = (look_.filter ? 0.9 : 0.1) / pixel.wanted, of_light = 1.0 / pixel.wanted;
    for (int c = 0; c < 3; ++c) {
        std::array<double, kParts> residual; // a pixel is a sum of light over one of alpha
        for (std::size_t p = 0; p < kParts; ++p) {
            const SampleSum& part = pixel.parts[p];
            const double light = part.light[c] + background_[c] * part.transmittance * back_alpha,
                         alpha = part.weight - part.transmittance * (1 - back_alpha);
            residual[p] = (light - whole.light[c] * alpha) / (all.weight * whole.alpha / kParts);
        }
        const double error =
            std::max(standard_error(residual),
                     hidden * (pixel.high[c] - pixel.low[c]) + of_light * pixel.in_doubt[c]);
        const double low = std::max(whole.light[c] - error, 0.0), high = whole.light[c] + error;
        const double codes = (code_of(high) - code_of(low)) * (error / (high - low + 0x1p-100));
        pixel.error = std::max(pixel.error, codes);
        if (!(error > 0)) continue;
        // Of that channel whose parts differ most: halves that differ by chance choose none.
        Scatter here = scatter(residual);
        here.of_parts *= codes / error * (codes / error);
        here.of_halves *= codes / error * (codes / error);
        if (here.of_parts > pixel.scatter.of_parts) pixel.scatter = here;
    }
    pixel.error *= kMargin;
}

// The next sample of the pixel, into the part that its number belongs to: into one of all parts of
// the first set, or, of a later set, which is as large as all before it, into one of the second
// half of them.
void Tracer::take(PixelSamples& p) const {
    const std::uint32_t seed = seed_of_pixel(p.x + (seed_ << 16), p.y), index = p.taken++;
    DVec2 at = stratified(index, 0, seed);
    double weight = 1;
    if (look_.filter) { // three pixels wide
        at = at * 3.0 - DVec2(1);
        weight = look_.filter(std::abs(at.x - 0.5)) * look_.filter(std::abs(at.y - 0.5));
    }
    const Sample sample = trace(world_.ray(p.x + at.x, p.y + at.y), index, seed);
    const DVec3 whole = sample.light + background_ * sample.transmittance;
    p.low = glm::min(p.low, whole);
    p.high = glm::max(p.high, whole);
    p.in_doubt = glm::max(p.in_doubt, sample.in_doubt);
    const std::size_t part = p.halved == 0
                                 ? index / (p.wanted / kParts)
                                 : kParts / 2 + (index - p.halved) / (p.halved / (kParts / 2));
    p.parts[part].add(sample, weight);
}

bool Tracer::advance(PixelSamples& p, std::uint32_t most, Time until) const {
    constexpr std::uint32_t kSamplesALook = 4; // at the clock
    for (;;) {
        while (p.taken < p.wanted) {
            take(p);
            if (p.taken % kSamplesALook == 0 && std::chrono::steady_clock::now() >= until)
                return false;
        }
        estimate_error(p);
        if (p.error < kErrorWanted || p.wanted >= most) return true;
        // Twice as many: the parts that there are become half of them.
        for (std::size_t i = 0; i < kParts / 2; ++i) {
            SampleSum pair = p.parts[2 * i];
            pair.add(p.parts[2 * i + 1]);
            p.parts[i] = pair;
        }
        std::fill(p.parts.begin() + kParts / 2, p.parts.end(), SampleSum());
        p.halved = p.wanted;
        p.wanted *= 2;
    }
}

TracedPixel Tracer::pixel(const PixelSamples& done) const {
    SampleSum all;
    for (const SampleSum& part : done.parts)
        all.add(part);
    const Mean whole = mean(all);
    double contrast = 0;
    for (int c = 0; c < 3; ++c)
        contrast = std::max(contrast, code_of(done.high[c]) - code_of(done.low[c]));
    const auto code = [&](int c) {
        return static_cast<std::uint8_t>(code_of(whole.light[c]) + 0.5);
    };
    return {whole.light, {code(0), code(1), code(2), static_cast<std::uint8_t>(255 * whole.alpha)},
            done.error,  done.scatter,
            done.wanted, contrast};
}

} // namespace scanout::trace
