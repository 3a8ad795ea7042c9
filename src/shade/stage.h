// The shading stages: each works through a block of up to 128 visible pixels ("items") that share a
// material, whatever triangles they come from. The plan picks one stage an axis; stages add up
// instead of multiplying. Structure of arrays, single precision, one operation sequence a item.
#pragma once

#include "base/technique.h"
#include "math/vec.h"
#include "scene/light.h"
#include "scene/material.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scanout::shade {

inline constexpr int kBlockSize = 128; // items of a shading block

// Kernels work on whole registers and may read and write this many items beyond the live ones; what
// stands there is finite.
inline constexpr int kPaddedBlock = kBlockSize + 16;

// What a map's texels mean: sRGB colours, linear numbers, or that only their alpha counts.
enum class TexelKind : std::uint8_t { colour, data, alpha };

// The maps that a material can have.
enum Map : std::uint8_t {
    kDiffuseMap,
    kOpacityMap,
    kNormalMap,
    kBumpMap,
    kSpecularMap,
    kShininessMap,
    kRoughnessMap,
    kMetalnessMap,
    kEmissionMap,
    kMaps
};
using MapBits = std::uint16_t;
constexpr MapBits bit_of(Map map) {
    return static_cast<MapBits>(1U << map);
}

// What a stage reads: vertex attributes, maps, and the ray from the eye.
struct Attributes {
    // uv: the model's own; a mapping stage makes them of the place in object space instead.
    bool normal = false, uv = false, colour = false, ray = false, position = false;
    bool primitive = false; // its runs' own
    bool vertices = false;  // normals and positions of the vertices; no item needs its own
    bool facing = false;    // Primitive::facing
    bool footprint = false; // how u and v change from pixel to pixel
    bool object = false;    // vertices' places in object space
    bool steps = false;     // FrameState::steps
    MapBits maps = 0;
    friend bool operator==(const Attributes&, const Attributes&) = default;
};
constexpr Attributes operator|(Attributes a, Attributes b) {
    return {a.normal || b.normal,       a.uv || b.uv,
            a.colour || b.colour,       a.ray || b.ray,
            a.position || b.position,   a.primitive || b.primitive,
            a.vertices || b.vertices,   a.facing || b.facing,
            a.footprint || b.footprint, a.object || b.object,
            a.steps || b.steps,         static_cast<MapBits>(a.maps | b.maps)};
}

// Does some stage read what a run's items share? Then no item sets up a triangle of its own.
constexpr bool reads_primitives(const Attributes& a) {
    return a.primitive || a.vertices || a.object;
}

// What all items of one triangle share, or of a clipped part of it, the vertices in canonical
// order.
struct Primitive {
    std::uint32_t id;
    // weight_i = a_i x + b_i y + c_i at a sample (x, y in 1/256 pixel): twice the area opposite
    // vertex i, whole numbers and exact, where the triangle was not clipped; else
    // raster::ClippedWeights. Inside, none is negative.
    double a[3], b[3], c[3];
    // The same modulo 2^32, where the triangle is so small that its weights within a pixel of it
    // are numbers of 32 bits; else not fits_int32.
    std::int32_t a_int32[3], b_int32[3], c_int32[3];
    bool fits_int32;
    double least[3]; // a sample is covered where weight_i >= least_i: the top-left rule; 0 and not
                     // asked for where the triangle was clipped
    bool clipped;
    // Of the first of two clipped triangles: the vertex opposite the edge where the second begins,
    // which is where that one's weight is negative; kFolded where snapping has turned one of them
    // over, so that both lie on one side of the edge; -1 where there is no second.
    static constexpr std::int8_t kFolded = 3;
    std::int8_t across;
    // Of a clipped triangle: a vertex lies at parameter t between one of the triangle's vertices
    // and another. Where the frame reads `corners`, position and normal are the triangle's.
    std::uint8_t from[3], to[3];
    float t[3];
    float inverse_w[3]; // of the vertices; 1 where it was clipped: those weights hold it already
    float facing[3];    // the triangle's own normal, towards the eye; object space
    bool back;          // with `facing`: the eye sees the side from which it winds clockwise
    std::int8_t step;   // of adaptive interpolation (interpolation_step.h); 0: every pixel
    // Of the three vertices; only what the frame's stages read. [component][vertex]; normals in
    // object space, or unit in view space where the frame says vertex_normals.
    float normal[3][3], uv[2][3], colour[3][3];
    float position[3][3]; // view space, times scene::to_floats
    float object[3][3];   // place in object space
    // u or v reaches beyond geom::Mesh::kLargeUv, in a frame with exact_uv: those and 1 / w before
    // they were rounded to floats.
    bool large_uv;
    double exact_uv[2][3], exact_inverse_w[3];
};

// Consecutive items of one triangle, in whatever pixels. A block's runs follow each other without a
// gap.
struct Run {
    const Primitive* primitive; // null: each item has a triangle of its own (shading_setup.h)
    int first, count;           // items
};

// Where a material keeps each, and how its texels are read.
struct MapSlot {
    scene::MaterialMap scene::Material::*map;
    TexelKind kind;
};
const std::array<MapSlot, kMaps>& map_slots(); // [Map]

struct MipChain;

using scene::Wrap;

// A map of the block's material; no texture where the material has none, or where no stage of the
// frame reads it.
struct BoundMap {
    const scene::Texture* texture = nullptr;
    const scene::TextureMap* map = nullptr; // its options
    const MipChain* mips = nullptr;         // null where the texture is nowhere minified
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

// A light as the items of a block see it.
struct BlockLight {
    alignas(64) float towards[3][kPaddedBlock]; // unit, view space
    alignas(64) float colour[3][kPaddedBlock];  // what arrives: linear
};

struct Stage;
struct BlendedPixels;
struct VertexLighting;
struct ShadingSetup;
struct LightShadow;
struct OcclusionImage;
struct TileShadow;

struct ShadingBlock {
    int count = 0; // live items
    const scene::Material* material = nullptr;
    const Stage* model = nullptr; // how the material reflects
    DVec2 uv_step{0}; // how far u and v may move (scene/uv_step.h); 0: not at all, or not asked for
    BoundMap map[kMaps];
    bool lit = true;      // false: lines and points, drawn in their plain colour; there are no runs
    bool occluded = true; // false: blended surfaces, which ambient occlusion does not darken

    // Set by the gatherer. x, y: the sample that stands for the item's pixel, 1/256 pixel: at the
    // centre if the triangle covers it, else where it shows.
    int runs = 0;
    Run run[kBlockSize];
    ShadingSetup* triangles = nullptr; // of items whose runs have no primitive
    alignas(64) std::int32_t x[kPaddedBlock], y[kPaddedBlock];
    // Its direction in view space: (x, y, -1).
    alignas(64) float ray_x[kPaddedBlock], ray_y[kPaddedBlock];
    // Where items are no pixels: unit, from the surface to the eye, in the ray's stead.
    const float (*eye)[kPaddedBlock] = nullptr;
    VertexLighting* vertex_lighting = nullptr; // room for the stages that light vertices or faces

    // Written by the interpolation stage.
    alignas(64) float normal[3][kPaddedBlock]; // unit, view space, on the side that the eye sees
    alignas(64) float u[kPaddedBlock], v[kPaddedBlock];
    alignas(64) float position[3][kPaddedBlock]; // view space, times scene::to_floats
    // Change of u and v a pixel, to the right and downwards; where the frame asks for a footprint.
    alignas(64) float u_x[kPaddedBlock], v_x[kPaddedBlock], u_y[kPaddedBlock], v_y[kPaddedBlock];

    // Written by the maps of normals and bumps: directions of u and v on the surface (map/tangent).
    alignas(64) float tangent[2][3][kPaddedBlock];

    // Of the map that was sampled last: red, green, blue, or alpha; linear.
    alignas(64) float sampled[4][kPaddedBlock];

    // Written by map/opacity: how much of what lies behind the item does not show.
    alignas(64) float alpha[kPaddedBlock];

    // Written by the light stages: what comes from everywhere (linear), and one entry a light of
    // the frame for those that FrameState::varies names.
    Vec3 ambient{0};
    // What comes from hemispheres on top of it, by items: where `hemispheres`.
    bool hemispheres = false;
    alignas(64) float from_hemispheres[3][kPaddedBlock];
    std::vector<BlockLight> light;
    const TileShadow* shadow = nullptr;     // set with the tile, in frames that count shadows
    const BlendedPixels* blended = nullptr; // set with the tile, where surfaces blend

    // Ks, Ns, Pr and Pm times their maps, where the block has these maps; else the material's own
    // count.
    alignas(64) float specular[3][kPaddedBlock], shininess[kPaddedBlock];
    alignas(64) float roughness[kPaddedBlock], metalness[kPaddedBlock];

    // Kd, times vertex colour, times map_Kd; and the result, linear light. Where the block is not
    // lit, the gatherer writes the albedo.
    alignas(64) float albedo[3][kPaddedBlock];
    alignas(64) float colour[3][kPaddedBlock];
};

// The next `count` items are of a primitive; whoever adds them sets their x and y.
inline void add_items(ShadingBlock& b, const Primitive* primitive, int count) {
    if (b.runs > 0 && b.run[b.runs - 1].primitive == primitive)
        b.run[b.runs - 1].count += count;
    else
        b.run[b.runs++] = {primitive, b.count, count};
    b.count += count;
}
// The next item, at a sample (1/256 pixel).
inline void add_item(ShadingBlock& b, const Primitive& primitive, std::int32_t x, std::int32_t y) {
    b.x[b.count] = x;
    b.y[b.count] = y;
    add_items(b, &primitive, 1);
}

struct Filter;
struct StepLimits;
struct Source;

// Which side of a face its normals light. All normals of a face are turned together, as in GL: one
// that leans to the other side than the rest, as smooth normals may do, keeps its direction. The
// front is where the steepest of them points, the one nearest to the face's own normal.
enum class Sides : std::uint8_t {
    eye,  // the one that the eye sees
    face, // the same where fronts are the sides from which faces wind counter-clockwise
    file  // the one that the file's normals point to
};

// What all blocks of a frame share.
struct FrameState {
    float normal_matrix[3][3] = {}; // object -> view, row major
    bool orthographic = false;      // then every ray is (0, 0, -1)
    Attributes attributes;          // what this frame's plan reads
    Vec3 ambient{0};                // of all ambient lights together
    std::span<const scene::ViewLight> hemispheres;
    std::span<const scene::ViewLight> lights; // the others
    // Of each light: differs from item to item, as do points, spots and all that is shadowed.
    // Empty: none does.
    std::span<const bool> varies;
    const Filter* filter = nullptr;         // how maps are read; null where no stage reads one
    std::span<const Vec3> triangle_colours; // in place of light, where colours say something else
    float farthest = 0, codes_a_unit = 0;   // of depth as a colour: times scene::to_floats
    const Source* source = nullptr; // what map_Kd is, instead of the picture that the file names
    bool mapped = false;            // a mapping stage writes u and v; they are not the model's
    std::array<const Stage*, scene::kSurfaces> reflection{}; // [Surface]
    // By material, the default one last: 1 where its maps leave no highlight. Empty: nowhere.
    std::span<const std::uint8_t> matt;
    bool is_matt(std::int32_t material) const { // -1: the default one
        return !matt.empty() &&
               matt[material < 0 ? matt.size() - 1 : static_cast<std::size_t>(material)] != 0;
    }
    Sides sides = Sides::eye;
    bool vertex_normals = false;                 // vertices' normals are unit, in view space
    std::span<const Stage* const> vertex_lights; // the light stages that run over vertices
    const LightShadow* shadows = nullptr;        // of each light; null: none casts
    const OcclusionImage* occlusion = nullptr;   // of ambient light; null: nothing hides it
    // By material, the default one last: 1 where it is blended. Empty: nowhere.
    std::span<const std::uint8_t> blends;
    bool is_blended(std::int32_t material) const { // -1: the default one
        return !blends.empty() &&
               blends[material < 0 ? blends.size() - 1 : static_cast<std::size_t>(material)] != 0;
    }
    int shadow_filter = 3;             // texels a side that a filtered shadow asks
    const StepLimits* steps = nullptr; // of adaptive interpolation; null where none is
    bool exact_uv = false;             // large u and v are mixed in double
    // No stage asks for runs' primitives: items may have triangles of their own.
    bool per_item_setup = false;
    float exposure = 1; // what light is multiplied by before it is shown
    float white = 1;    // the light that a tone curve makes 1; at least 1
};

// Some stage of the frame wants the block's u and v.
inline bool wants_uv(const ShadingBlock& b, const FrameState& frame) {
    if (!(frame.attributes.uv || frame.mapped) || !b.lit) return false;
    if (frame.source != nullptr) return true;
    for (unsigned rest = frame.attributes.maps; rest != 0; rest &= rest - 1)
        if (b.map[std::countr_zero(rest)].texture != nullptr) return true;
    return false;
}

// When a stage runs, in this order. Maps change what light falls on, so they come before it; what a
// surface gives off by itself is added to what it reflects, and no shadow darkens it.
enum class Pass : std::uint8_t {
    interpolation,
    mapping,
    maps,
    light,
    shadow,
    shading,
    emission,
    exposure,
    tone,
    called // by a stage of another pass
};

struct Stage {
    Technique card;
    Pass pass;
    Attributes needs;
    void (*run)(ShadingBlock& block, const FrameState& frame); // null: there is nothing to do
};

struct LightTraits {
    scene::LightKind kind;
};
struct LightStage : Stage, LightTraits {};

struct ReflectionTraits {
    bool highlight = true; // where Ks and Ns give one
    bool physical = false; // by Pr and Pm, where the material says them
    // The same without a highlight; null: that is lambert, or this stage where it has none.
    const Stage* matt = nullptr;
};
struct ReflectionStage : Stage, ReflectionTraits {};

struct ShadingTraits {
    bool unit_vertex_normals = false; // reads what FrameState::vertex_normals says
};
struct ShadingStage : Stage, ShadingTraits {};

// What finds the surfaces that stand in a light's way.
enum class ShadowBy : std::uint8_t { facing, projection, maps, volumes };
struct ShadowTraits {
    ShadowBy by;
    bool filtered = false; // asks FrameState::shadow_filter texels a side
    bool soft = false;     // by the size of the light
};
struct ShadowStage : Stage, ShadowTraits {};

struct ToneTraits {
    bool exact_below_white = false; // where no light is above 1, none is changed
};
struct ToneStage : Stage, ToneTraits {};

// A texture filter: reads a map at b.u, b.v into b.sampled: its first three rows, or, where only
// alpha counts, its last.
struct Filter {
    Technique card;
    Attributes needs;
    void (*sample)(ShadingBlock& block, const BoundMap& map, TexelKind kind);
};

// A choice of what lies beyond a texture's edges.
struct Wrapping {
    Technique card;
    Wrap wrap;
};

// Where a texture comes from: computes b.sampled from u and v; null is the picture that the file
// names.
struct Source {
    Technique card;
    Attributes needs;
    void (*sample)(ShadingBlock& block);
};

// Every stage there is, in the order of techniques.h; null where there is no such name.
std::span<const Stage* const> stages();
const Stage* find_stage(std::string_view axis, std::string_view name);

} // namespace scanout::shade
