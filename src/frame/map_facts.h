// Which maps a scene calls for, by what their pictures hold: a normal map that is flat everywhere,
// a map_Ks that is white, a bump map of one height change nothing.
#pragma once

#include "scene/scene.h"
#include "shade/stage.h"

#include <string_view>
#include <vector>

namespace scanout::frame {

// The row of the plan that decides about a map; empty where it is not the map's alone.
std::string_view map_effect(shade::Map map);

// Whether leaving the map out could change a pixel of this material, whatever the view; there must
// be coordinates for it. Maps that could not be read do not matter.
class MapFacts {
public:
    explicit MapFacts(const scene::Scene& scene);
    bool matters(const scene::Material& material, shade::Map map) const;

private:
    // What all texels of a texture have in common.
    struct Content {
        bool constant = true; // one colour
        bool white = true;    // r, g, b and alpha are 255
        bool flat = true;     // r and g are 128: as a normal map, no slope
    };
    static Content content_of(const image::Image& image);
    std::vector<Content> content_; // of each texture that is such a map
};

} // namespace scanout::frame
