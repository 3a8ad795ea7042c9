// Maps at their full resolution: the four nearest texels, weighted by distance, in linear light.
// Where a pixel shows more texels than it has samples, more samples are taken.
#pragma once

#include "scene/material.h"
#include "trace/look.h"

namespace scanout::trace {

// Linear light of the four channels, the last being alpha. encoded: colours are sRGB; else they are
// linear numbers. u and v are the surface's: the map's own options are applied here.
DVec4 texel(const scene::Texture& texture, const scene::TextureMap& map, Edges edges,
            const DVec2& uv, bool encoded);

// A number: of the channel that -imfchan names, else how bright the texel is (Rec. 709).
double scalar_of(const DVec4& texel, char channel);

} // namespace scanout::trace
