// What shading a tile needs to know of the frame.
#pragma once

#include "geom/mesh.h"
#include "image/image.h"
#include "raster/stage/geometry.h"
#include "scene/view.h"
#include "shade/gather/added_lines.h"
#include "shade/gather/block_pixels.h"
#include "shade/gather/shading_key.h"
#include "shade/mip/mip_chain.h"
#include "shade/resolve/linear_picture.h"
#include "shade/resolve/output.h"
#include "shade/stage.h"
#include "shade/transparency.h"

#include <cstdint>
#include <optional>
#include <span>

namespace scanout::shade {

// What is not opaque, and how it is drawn.
struct TransparencyInput {
    const Transparency* cut_out = nullptr; // null where no triangle wants it
    const Transparency* blended = nullptr;
    const Blend* blend = nullptr;
    bool opaque_blended = false;          // all that is blended has alpha 1
    std::span<const MaterialAlpha> alpha; // of the default material, then of each of the scene
    std::span<const Stage* const> stages; // find alpha
    FrameState frame;                     // of those stages
    float cut = 0.5F;              // least alpha that is drawn, unless a material has its own
    std::size_t max_fragments = 0; // of a list; what is drawn does not depend on it
};

struct GatherInput {
    const geom::Mesh* mesh = nullptr;
    ShadingKeys keys;                  // of the mesh
    const AddedLines* added = nullptr; // beside the mesh's; null: none
    const raster::Geometry* geometry = nullptr;
    const raster::ScreenTransform* transform = nullptr;
    const scene::View* view = nullptr;
    double unit = 1; // scene::to_floats of the view
    std::span<const scene::Material> materials;
    const scene::Material* unnamed = nullptr; // of the scene
    std::span<const scene::Texture> textures;
    const MipChains* mips = nullptr;
    std::optional<Wrap> wrap; // of every map; else as each says
    std::span<const DVec2>
        uv_steps; // of the materials (scene/uv_step.h), where frames mix exact uv
    std::span<const Stage* const> stages;
    const FrameState* frame = nullptr;
    bool mirrored = false;
    Rays rays;
    image::Rgba8 background{};
    Output output;
    LinearPicture* linear = nullptr;                 // also kept there
    const TransparencyInput* transparency = nullptr; // null where all is opaque

    void set_view(const scene::View& of) {
        view = &of;
        unit = scene::to_floats(of);
    }
    const scene::Material& material(std::int32_t index) const; // -1: the unnamed one
    DVec2 uv_step(std::int32_t material) const;                // 0: u and v stay where they are
};

// A map of a material, ready to be read: it has a texture.
BoundMap bound_map(const GatherInput& input, Map map, const scene::Material& material);

// Where a triangle is shaded in a pixel, 1/256 pixel of the picture: at the centre where it covers
// it, else at a sample that it covers.
raster::SampleOffset place_in_pixel(const GatherInput& input, const Primitive& primitive, int x,
                                    int y, raster::SampleOffset sample);

} // namespace scanout::shade
