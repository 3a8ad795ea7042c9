#include "shade/corner_light.h"

#include "base/check.h"
#include "math/rotation.h"
#include "shade/check_lanes.h"
#include "shade/primitives.h"

#include <algorithm>
#include <array>

namespace scanout::shade {
namespace {

// A point of a surface, in view space.
struct Corner {
    DVec3 position, normal; // unit
};

Corner corner_of(const Primitive& t, int k) {
    return {DVec3(t.position[0][k], t.position[1][k], t.position[2][k]),
            DVec3(t.normal[0][k], t.normal[1][k], t.normal[2][k])};
}

// The middle of the face, and the face's own normal.
Corner face_of(const Primitive& t, const FrameState& frame) {
    Corner face;
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

class CornerLighter {
public:
    CornerLighter(Block& block, const FrameState& frame, int corners)
        : block_(block), light_(*block.corners), frame_(frame), corners_(corners) {
        frame_.attributes.position = true; // of these lanes
        Block& b = light_.lanes;
        b.material = block.material;
        b.model = block.model;
        b.eye = light_.eye;
        b.ambient = Vec3(0);
        b.light.resize(frame.varies.empty() ? 0 : frame.lights.size());
        b.count = 0;
    }

    void run() {
        find_triangles();
        for (std::size_t i = 0; i < triangles_; ++i) {
            if (light_.lanes.count + corners_ > kBlockSize) flush(i);
            for (int k = 0; k < corners_; ++k)
                add(corners_ == 1 ? face_of(*seen_[i], frame_) : corner_of(*seen_[i], k));
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
            while (used[slot] && seen_[place[slot]] != t)
                slot = (slot + 1) % kSlots;
            if (!used[slot]) {
                used[slot] = true;
                place[slot] = static_cast<std::uint8_t>(triangles_);
                seen_[triangles_++] = t;
            }
            light_.of_run[r] = place[slot];
        }
    }

    void add(const Corner& corner) {
        Block& b = light_.lanes;
        const DVec3 eye = frame_.orthographic ? DVec3(0, 0, 1) : normalized(-corner.position);
        for (int c = 0; c < 3; ++c) {
            b.position[c][b.count] = static_cast<float>(corner.position[c]);
            b.normal[c][b.count] = static_cast<float>(corner.normal[c]);
            light_.eye[c][b.count] = static_cast<float>(eye[c]);
        }
        ++b.count;
    }

    // From the triangle's vertices to those of its piece that is drawn.
    static void cut(const Primitive& t, float (&light)[3][3]) {
        for (auto& channel : light) {
            const std::array<float, 3> whole = {channel[0], channel[1], channel[2]};
            for (int k = 0; k < 3; ++k)
                channel[k] = between(whole[t.from[k]], whole[t.to[k]], double{t.share[k]});
        }
    }

    // Runs the stages over what was added; the triangles before `end` are lit then.
    void flush(std::size_t end) {
        Block& b = light_.lanes;
        for (const Stage* stage : frame_.corner_lights)
            stage->run(b, frame_);
        reflect(0.0F, &CornerLight::Triangle::plain);
        reflect(1.0F, &CornerLight::Triangle::tinted);
        for (std::size_t i = lit_; i < end; ++i)
            for (int c = 0; c < 3; ++c)
                for (int k = 0; k < corners_; ++k)
                    light_.triangle[i].tinted[c][k] -= light_.triangle[i].plain[c][k];
        if (corners_ == 3)
            for (std::size_t i = lit_; i < end; ++i)
                if (seen_[i]->clipped) {
                    cut(*seen_[i], light_.triangle[i].plain);
                    cut(*seen_[i], light_.triangle[i].tinted);
                }
        lit_ = end;
        b.count = 0;
    }

    // The model's colours for this albedo.
    void reflect(float albedo, float (CornerLight::Triangle::*to)[3][3]) {
        Block& b = light_.lanes;
        for (auto& channel : b.albedo)
            std::fill_n(channel, kPaddedBlock, albedo);
        b.model->run(b, frame_);
        for (const float* channel : b.colour)
            check_values({channel, static_cast<std::size_t>(b.count)}, "colour",
                         "light at corners");
        for (int lane = 0; lane < b.count; ++lane) {
            CornerLight::Triangle& t =
                light_.triangle[lit_ + static_cast<std::size_t>(lane / corners_)];
            for (int c = 0; c < 3; ++c)
                (t.*to)[c][lane % corners_] = b.colour[c][lane];
        }
    }

    Block& block_;
    CornerLight& light_;
    FrameState frame_;
    int corners_; // a triangle
    std::array<const Primitive*, kBlockSize> seen_{};
    std::size_t triangles_ = 0, lit_ = 0;
};

} // namespace

void light_corners(Block& block, const FrameState& frame) {
    CHECK(block.corners != nullptr);
    CornerLighter(block, frame, 3).run();
}

void light_faces(Block& block, const FrameState& frame) {
    CHECK(block.corners != nullptr);
    CornerLighter(block, frame, 1).run();
}

} // namespace scanout::shade
