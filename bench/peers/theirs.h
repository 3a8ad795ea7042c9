// A load drawn by llvmpipe: one indexed draw of static vertices into a frame buffer object, and the
// read-back of the picture.
#pragma once

#include "bench/peers/gl_program.h"
#include "bench/peers/load.h"
#include "image/image.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

namespace scanout::bench {

class Theirs {
public:
    // The context must be current and outlive it. placed: triangles stand as in the scene, which
    // may have put them in an order by place; else as in the file, as a viewer would hand them to
    // GL.
    static Result<Theirs> create(const scene::Scene& scene, const Load& load, int width, int height,
                                 bool placed);

    // Draws the frame and reads it back.
    void draw(const scene::View& view);
    // Fragments that pass the depth test in the order of the triangles, a sample.
    double fragments(const scene::View& view);

    // What was read, rows from the top, encoded to sRGB: GL wrote linear light into its codes.
    image::Image picture() const;
    // Distances from the eye, bounding radii; 0 where nothing is.
    std::vector<float> distances(const scene::View& view) const;

private:
    Theirs() = default;
    void upload(const scene::Scene& scene, bool placed);
    Result<void> make_targets();
    void make_shadow_map();
    void clear_and_draw(const scene::View& view);
    void draw_shadow_map(const scene::View& view);
    void set_uniforms(const scene::View& view, const glm::mat4& to_shadow) const;
    void read();

    int width_ = 0, height_ = 0, samples_ = 1;
    Shading shading_{};
    bool inside_ = false;
    GLsizei indices_ = 0;
    GLuint program_ = 0, shadow_program_ = 0;
    GLuint drawn_ = 0, resolved_ = 0; // frame buffer objects; the same with one sample
    GLuint shadow_target_ = 0, shadow_texture_ = 0, texture_ = 0;
    glm::mat4 to_shadow_{1};
    std::vector<std::uint32_t> read_; // BGRA codes, or depth as floats; rows from the bottom
};

} // namespace scanout::bench
