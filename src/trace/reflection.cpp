#include "trace/reflection.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::trace {
namespace {

// Lambert 1760.
DVec3 lambert(const Surface& s, const DVec3& /*eye*/, const DVec3& ambient,
              std::span<const Arrival> lights) {
    DVec3 sum = ambient;
    for (const Arrival& light : lights)
        sum = sum + light.colour * std::max(dot3(s.normal, light.towards), 0.0);
    return s.albedo * sum;
}

// Ns below 1 counts as 1, and Ks fades with it.
double exponent_of(const Surface& s) {
    return std::max(s.shininess, 1.0);
}
DVec3 specular_of(const Surface& s) {
    return s.specular * std::min(s.shininess, 1.0);
}

double half_vector_cosine(const Surface& s, const DVec3& eye, const DVec3& light) {
    const DVec3 half = eye + light;
    const double size = scanout::sqrt(dot3(half, half));
    return size > 0x1p-20 ? dot3(s.normal, half) / size : 0;
}

double power(double cosine, double exponent) {
    return cosine > 0 ? pow(std::min(cosine, 1.0), exponent) : 0;
}

// Lambert, and Ks times a share of every light: of(light).
template <class Of>
DVec3 with_highlights(const Surface& s, const DVec3& eye, const DVec3& ambient,
                      std::span<const Arrival> lights, Of of) {
    DVec3 sum = lambert(s, eye, ambient, lights);
    if (!s.highlight) return sum;
    for (const Arrival& light : lights)
        sum = sum + light.colour * specular_of(s) * of(light.towards);
    return sum;
}

// Blinn 1977.
DVec3 blinn_phong(const Surface& s, const DVec3& eye, const DVec3& ambient,
                  std::span<const Arrival> lights) {
    return with_highlights(s, eye, ambient, lights, [&](const DVec3& light) {
        if (!(dot3(s.normal, light) > 0)) return 0.0;
        return power(half_vector_cosine(s, eye, light), exponent_of(s));
    });
}

// Giesen 2009: of the factor that keeps energy, exactly.
DVec3 blinn_phong_normalised(const Surface& s, const DVec3& eye, const DVec3& ambient,
                             std::span<const Arrival> lights) {
    const double ns = exponent_of(s);
    const double factor = (ns + 2) * (ns + 4) / (8 * (exp2(-ns / 2) + ns));
    return with_highlights(s, eye, ambient, lights, [&](const DVec3& light) {
        return factor * std::max(dot3(s.normal, light), 0.0) *
               power(half_vector_cosine(s, eye, light), ns);
    });
}

// Phong 1975.
DVec3 phong(const Surface& s, const DVec3& eye, const DVec3& ambient,
            std::span<const Arrival> lights) {
    return with_highlights(s, eye, ambient, lights, [&](const DVec3& light) {
        const double falls = dot3(s.normal, light);
        if (!(falls > 0)) return 0.0;
        const DVec3 mirrored = s.normal * (2 * falls) - light;
        return power(dot3(mirrored, eye), exponent_of(s));
    });
}

// Three tones; a hard highlight. Lake, Marshall, Harris and Blackwell 2000.
DVec3 toon(const Surface& s, const DVec3& eye, const DVec3& ambient,
           std::span<const Arrival> lights) {
    DVec3 diffuse = ambient, mirrored{0};
    for (const Arrival& light : lights) {
        const double cosine = dot3(s.normal, light.towards);
        if (!(cosine > 0)) continue;
        diffuse = diffuse + light.colour * ((std::min(std::floor(cosine * 3), 2.0) + 0.5) / 3);
        const double lobe = power(half_vector_cosine(s, eye, light.towards), exponent_of(s));
        if (s.highlight && lobe >= 0.5) mirrored = mirrored + light.colour;
    }
    return s.albedo * diffuse + specular_of(s) * mirrored;
}

// (1 - x)^5: Schlick 1994.
double schlick(double x) {
    const double y = std::max(1 - x, 0.0);
    return y * y * (y * y) * y;
}

// Trowbridge and Reitz 1975, Walter et al. 2007; Heitz 2014, eq. 99. What is scattered passes the
// surface twice.
DVec3 ggx(const Surface& s, const DVec3& eye, const DVec3& ambient,
          std::span<const Arrival> lights) {
    if (!s.highlight) return lambert(s, eye, ambient, lights);
    const double wide =
        s.physical ? s.roughness * s.roughness : scanout::sqrt(2 / (exponent_of(s) + 2));
    const double alpha = std::clamp(wide, 0x1p-9, 1.0), alpha2 = alpha * alpha;
    const double metal = s.physical ? std::clamp(s.metalness, 0.0, 1.0) : 0, other = 1 - metal;
    const DVec3 f0 = s.physical ? DVec3(0.04) : glm::clamp(specular_of(s), DVec3(0), DVec3(1));
    const double n_e = std::clamp(dot3(s.normal, eye), 0x1p-10, 1.0);
    DVec3 sum = s.albedo * ambient;
    for (const Arrival& light : lights) {
        const double n_l = std::clamp(dot3(s.normal, light.towards), 0.0, 1.0);
        if (n_l == 0) continue;
        const DVec3 both = eye + light.towards;
        const double size = std::max(scanout::sqrt(dot3(both, both)), 0x1p-20);
        const DVec3 half = both / size, sine = cross3(s.normal, half);
        const double n_h = dot3(s.normal, half), e_h = size / 2;
        double mirrored = 0; // pi D V n.l
        if (n_h > 0) {
            const double spread = dot3(sine, sine) + alpha2 * n_h * n_h;
            const double seen = n_l * scanout::sqrt(n_e * n_e * (1 - alpha2) + alpha2),
                         lit = n_e * scanout::sqrt(n_l * n_l * (1 - alpha2) + alpha2);
            mirrored = alpha2 / (spread * spread) * (0.5 * n_l / (seen + lit));
        }
        const double scattered = other * (1 - schlick(n_l)) * (1 - schlick(n_e)) * n_l;
        const double grazing = schlick(e_h);
        const DVec3 enters = DVec3(1) - f0, fresnel = f0 + enters * grazing;
        const DVec3 of_metal = s.albedo + (DVec3(1) - s.albedo) * grazing;
        sum = sum + light.colour * (s.albedo * (enters * enters) * scattered +
                                    (fresnel * other + of_metal * metal) * mirrored);
    }
    return sum;
}

} // namespace

Reflection find_reflection(std::string_view name) {
    constexpr std::pair<std::string_view, Reflection> kRows[] = {
        {"lambert", lambert}, {"toon", toon},
        {"phong", phong},     {"blinn_phong", blinn_phong},
        {"ggx", ggx},         {"blinn_phong_normalised", blinn_phong_normalised}};
    for (const auto& [known, reflection] : kRows)
        if (known == name) return reflection;
    return nullptr;
}

} // namespace scanout::trace
