// Facts about texture maps: which of them can change a pixel, by their texels and the material's
// factors. A normal map that is flat everywhere, a white map_Ks, and a map_Kd under a black Kd
// change nothing.
#pragma once

#include "scene/scene.h"
#include "shade/stage.h"

#include <array>
#include <string_view>
#include <vector>

namespace scanout::frame {

// The plan's row that decides about a map; empty where several things decide.
std::string_view map_effect(shade::Map map);

// For scenes with texture coordinates: without them no map is read, and none makes a product black.
// Maps whose file could not be read do not count.
class MapFacts {
public:
    explicit MapFacts(const scene::Scene& scene);
    // Whether leaving the map out could change a pixel of this material, whatever the view.
    bool matters(const scene::Material& material, shade::Map map) const;
    // The same for map_Ks or map_Ns, if physical materials reflect by Ks and Ns, too.
    bool matters_by_ks(const scene::Material& material, shade::Map map) const;
    // Whether all texels of a texture are one colour, so that every filter gives the same.
    bool constant(std::int32_t texture) const;
    // Whether the material's product of factor and map is above 0 somewhere.
    bool reflects(const scene::Material& material) const; // Kd
    bool shines(const scene::Material& material) const;   // a highlight
    bool shines_by_ks(const scene::Material& material) const;
    bool emits(const scene::Material& material) const; // Ke
    // Kd times the greatest texel of map_Kd, in each channel; linear.
    Vec3 brightest(const scene::Material& material) const;

private:
    // The least and the greatest code of a texture's red, green, blue and alpha.
    struct Range {
        std::array<std::uint8_t, 4> min{255, 255, 255, 255}, max{0, 0, 0, 0};
    };
    static Range range_of(const image::Image& image);
    // The range of the codes in the material's map; null where it has no map.
    const Range* range(const scene::Material& material, shade::Map map) const;
    // Whether the product of a colour and a map is black.
    bool is_black(const Vec3& colour, const Range* range) const;

    bool coordinates_;
    std::vector<Range> ranges_; // of each texture
};

} // namespace scanout::frame
