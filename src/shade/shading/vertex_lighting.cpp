#include "shade/shading/vertex_lighting.h"

#include "base/check.h"
#include "math/rotation.h"
#include "shade/check_lanes.h"
#include "shade/setup/clipped_primitive.h"

#include <algorithm>
#include <array>

namespace scanout::shade {
namespace {

// A point of a surface, in view space.
struct SurfacePoint {
    DVec3 position, normal; // unit
};

SurfacePoint vertex_of(const Primitive& t, int k) {
    return {DVec3(t.position[0][k], t.position[1][k], t.position[2][k]),
            DVec3(t.normal[0][k], t.normal[1][k], t.normal[2][k])};
}

// The middle of the face, and the face's own normal.
SurfacePoint face_of(const Primitive& t, const FrameState& frame) {
    SurfacePoint face;
    DVec3 normal;
    const auto& m = frame.normal_matrix;
    for (int c = 0; c < 3; ++c) {
        face.position[c] = ((t.position[c][0] + double{t.position[c][1]}) + t.position[c][2]) / 3;
        normal[c] = (double{m[c][0]} * t.facing[0] + double{m[c][1]} * t.facing[1]) +
                    double{m[c][2]} * t.facing[2];
    }
    face.normal = normalized(normal);
    return face;
}

class VertexLighter {
public:
    VertexLighter(ShadingBlock& block, const FrameState& frame, int vertices)
        : block_(block), light_(*block.vertex_lighting), frame_(frame),
          points_per_triangle_(vertices) {
        frame_.attributes.position = true; // of these items
        ShadingBlock& b = light_.items;
        b.material = block.material;
        b.model = block.model;
        b.eye = light_.eye;
        b.ambient = Vec3(0);
        b.hemispheres = false;
        b.light.resize(frame.varies.empty() ? 0 : frame.lights.size());
        b.count = 0;
    }

    void run() {
        find_triangles();
        for (std::size_t i = 0; i < triangles_; ++i) {
            if (light_.items.count + points_per_triangle_ > kBlockSize) flush(i);
            for (int k = 0; k < points_per_triangle_; ++k)
                add(points_per_triangle_ == 1 ? face_of(*visible_[i], frame_)
                                              : vertex_of(*visible_[i], k));
        }
        flush(triangles_);
    }

private:
    // Each triangle once, in the order in which runs show them.
    void find_triangles() {
        constexpr std::size_t kSlots = 2 * kBlockSize;
        std::array<std::uint8_t, kSlots> place;
        std::array<bool, kSlots> used{};
        for (int r = 0; r < block_.runs; ++r) {
            const Primitive* t = block_.run[r].primitive;
            std::size_t slot = t->id % kSlots;
            while (used[slot] && visible_[place[slot]] != t)
                slot = (slot + 1) % kSlots;
            if (!used[slot]) {
                used[slot] = true;
                place[slot] = static_cast<std::uint8_t>(triangles_);
                visible_[triangles_++] = t;
            }
            light_.of_run[r] = place[slot];
        }
    }

    void add(const SurfacePoint& point) {
        ShadingBlock& b = light_.items;
        const DVec3 eye = frame_.orthographic ? DVec3(0, 0, 1) : normalized(-point.position);
        for (int c = 0; c < 3; ++c) {
            b.position[c][b.count] = static_cast<float>(point.position[c]);
            b.normal[c][b.count] = static_cast<float>(point.normal[c]);
            light_.eye[c][b.count] = static_cast<float>(eye[c]);
        }
        ++b.count;
    }

    // From the triangle's vertices to those of the clipped triangle that is drawn.
    static void clip(const Primitive& t, float (&light)[3][3]) {
        for (auto& channel : light) {
            const std::array<float, 3> unclipped = {channel[0], channel[1], channel[2]};
            for (int k = 0; k < 3; ++k)
                channel[k] = between(unclipped[t.from[k]], unclipped[t.to[k]], double{t.t[k]});
        }
    }

    // Runs the stages over what was added; the triangles before `end` are lit then.
    void flush(std::size_t end) {
        ShadingBlock& b = light_.items;
        for (const Stage* stage : frame_.vertex_lights)
            stage->run(b, frame_);
        reflect(0.0F, &VertexLighting::Triangle::plain);
        reflect(1.0F, &VertexLighting::Triangle::tinted);
        for (std::size_t i = lit_; i < end; ++i)
            for (int c = 0; c < 3; ++c)
                for (int k = 0; k < points_per_triangle_; ++k)
                    light_.triangle[i].tinted[c][k] -= light_.triangle[i].plain[c][k];
        if (points_per_triangle_ == 3)
            for (std::size_t i = lit_; i < end; ++i)
                if (visible_[i]->clipped) {
                    clip(*visible_[i], light_.triangle[i].plain);
                    clip(*visible_[i], light_.triangle[i].tinted);
                }
        lit_ = end;
        b.count = 0;
    }

    // The model's colours for this albedo.
    void reflect(float albedo, float (VertexLighting::Triangle::*to)[3][3]) {
        ShadingBlock& b = light_.items;
        for (auto& channel : b.albedo)
            std::fill_n(channel, kPaddedBlock, albedo);
        b.model->run(b, frame_);
        for (const float* channel : b.colour)
            check_values({channel, static_cast<std::size_t>(b.count)}, "colour",
                         "light at vertices");
        for (int item = 0; item < b.count; ++item) {
            VertexLighting::Triangle& t =
                light_.triangle[lit_ + static_cast<std::size_t>(item / points_per_triangle_)];
            for (int c = 0; c < 3; ++c)
                (t.*to)[c][item % points_per_triangle_] = b.colour[c][item];
        }
    }

    ShadingBlock& block_;
    VertexLighting& light_;
    FrameState frame_;
    int points_per_triangle_; // a triangle
    std::array<const Primitive*, kBlockSize> visible_{};
    std::size_t triangles_ = 0, lit_ = 0;
};

} // namespace

void light_vertices(ShadingBlock& block, const FrameState& frame) {
    CHECK(block.vertex_lighting != nullptr);
    VertexLighter(block, frame, 3).run();
}

void light_faces(ShadingBlock& block, const FrameState& frame) {
    CHECK(block.vertex_lighting != nullptr);
    VertexLighter(block, frame, 1).run();
}

} // namespace scanout::shade
