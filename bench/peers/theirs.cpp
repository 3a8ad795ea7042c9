#include "bench/peers/theirs.h"

#include "bench/peers/gl_view.h"
#include "math/srgb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

namespace scanout::bench {
namespace {

struct Vertex {
    Vec3 position, normal;
    Vec2 uv;
};

struct Buffers {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> index;
};
// Triangles as the file has them, or in spatial order (geom/spatial_order.h); vertices as triangles use
// them first.
Buffers buffers_of(const geom::Mesh& mesh, bool placed) {
    std::vector<std::uint32_t> triangles(mesh.triangles());
    std::iota(triangles.begin(), triangles.end(), 0U);
    if (placed)
        for (std::uint32_t& t : triangles)
            t = mesh.triangle_at(t);
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::vector<std::uint32_t> number(mesh.position.size(), kNone);
    Buffers made;
    for (const std::uint32_t t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.index[std::size_t{t} * 3 + k];
            if (number[v] == kNone) {
                number[v] = static_cast<std::uint32_t>(made.vertices.size());
                made.vertices.push_back(
                    {mesh.position[v], mesh.normal[v], mesh.uv.empty() ? Vec2(0) : mesh.uv[v]});
            }
            made.index.push_back(number[v]);
        }
    return made;
}

// GL filters and writes codes as they are: they hold linear light, so that neither side encodes or
// decodes more than its own renderer does. Rows from the bottom, where v is 0.
std::vector<image::Rgba8> linear_codes(const image::Image& picture) {
    std::vector<image::Rgba8> codes;
    for (int y = picture.height() - 1; y >= 0; --y)
        for (const image::Rgba8& texel : picture.row(y)) {
            const auto code = [](std::uint8_t encoded) {
                return static_cast<std::uint8_t>(std::lround(srgb_decode(encoded) * 255));
            };
            codes.push_back({code(texel.r), code(texel.g), code(texel.b), texel.a});
        }
    return codes;
}

GLuint new_buffer(GLenum target, std::size_t bytes, const void* data) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
    return buffer;
}

void uniform(GLuint program, const char* name, const glm::mat4& m) {
    glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(m));
}
void uniform(GLuint program, const char* name, const Vec3& v) {
    glUniform3fv(glGetUniformLocation(program, name), 1, glm::value_ptr(v));
}

} // namespace

Result<Theirs> Theirs::create(const scene::Scene& scene, const Load& load, int width, int height,
                              bool placed) {
    Theirs t;
    t.width_ = width;
    t.height_ = height;
    t.samples_ = load.samples;
    t.shading_ = load.shading;
    t.inside_ = is_inside(load);
    const bool light = load.shading != Shading::depth;
    TRY(t.program_, make_program({light, load.shading == Shading::textured,
                                  load.shading == Shading::shadowed, light && t.inside_}));
    TRY(t.shadow_program_, make_program({}));
    t.upload(scene, placed);
    TRY_VOID(t.make_targets());
    if (load.shading == Shading::shadowed) t.make_shadow_map();
    t.read_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return t;
}

void Theirs::upload(const scene::Scene& scene, bool placed) {
    const Buffers buffers = buffers_of(scene.mesh, placed);
    GLuint layout = 0;
    glGenVertexArrays(1, &layout);
    glBindVertexArray(layout);
    new_buffer(GL_ARRAY_BUFFER, buffers.vertices.size() * sizeof(Vertex), buffers.vertices.data());
    new_buffer(GL_ELEMENT_ARRAY_BUFFER, buffers.index.size() * sizeof(buffers.index[0]),
               buffers.index.data());
    for (GLuint i = 0; i < 3; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, i == 2 ? 2 : 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(std::size_t{i} * sizeof(Vec3)));
    }
    indices_ = static_cast<GLsizei>(buffers.index.size());
    if (scene.textures.empty()) return;
    const image::Image& picture = scene.textures.front().image;
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width(), picture.height(), 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, linear_codes(picture).data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

Result<void> Theirs::make_targets() {
    GLuint targets[2] = {}, colour = 0, buffers[2] = {};
    glGenFramebuffers(2, targets);
    glGenRenderbuffers(2, buffers);
    resolved_ = drawn_ = targets[0];
    glGenTextures(1, &colour);
    glActiveTexture(GL_TEXTURE2); // the model's texture stays bound to unit 0
    glBindTexture(GL_TEXTURE_2D, colour);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    if (samples_ > 1) {
        drawn_ = targets[1];
        glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
        glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA8, width_, height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  buffers[0]);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    // Floats are read as they are: from 24 bits to a number takes llvmpipe twice the time of a
    // copy. Where no one reads depth, neither draws faster.
    const GLenum depth = shading_ == Shading::depth ? GL_DEPTH_COMPONENT32F : GL_DEPTH_COMPONENT24;
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_ > 1 ? samples_ : 0, depth, width_,
                                     height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(Exit::internal, "llvmpipe has no frame buffer of {}x{} with {} samples", width_,
                    height_, samples_);
    return {};
}

void Theirs::make_shadow_map() {
    glGenTextures(1, &shadow_texture_);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, shadow_texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kShadowTexels, kShadowTexels, 0,
                 GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glActiveTexture(GL_TEXTURE0);
    glGenFramebuffers(1, &shadow_target_);
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_texture_, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
}

void Theirs::draw_shadow_map(const scene::View& view) {
    const glm::mat4 light = to_light_clip(view);
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
    glViewport(0, 0, kShadowTexels, kShadowTexels);
    glClear(GL_DEPTH_BUFFER_BIT);
    glUseProgram(shadow_program_);
    uniform(shadow_program_, "to_clip", light);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2, 4);
    glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_POLYGON_OFFSET_FILL);
    const glm::mat4 half = glm::scale(glm::translate(glm::mat4(1), Vec3(0.5F)), Vec3(0.5F));
    to_shadow_ = half * light;
}

void Theirs::set_uniforms(const scene::View& view, const glm::mat4& to_shadow) const {
    glUseProgram(program_);
    uniform(program_, "to_clip", to_clip(view, inside_));
    uniform(program_, "to_view", to_view(view));
    uniform(program_, "to_shadow", to_shadow);
    const glm::mat3 normal(view.normal);
    glUniformMatrix3fv(glGetUniformLocation(program_, "normal_to_view"), 1, GL_FALSE,
                       glm::value_ptr(normal));
    uniform(program_, "to_light", Vec3(glm::normalize(kTowardsLight)));
    uniform(program_, "diffuse", Vec3(0.7F, 0.6F, 0.5F));
    uniform(program_, "specular", Vec3(0.3F));
    glUniform1f(glGetUniformLocation(program_, "ambient"), static_cast<float>(kAmbient));
    glUniform1f(glGetUniformLocation(program_, "shininess"), 32);
    glUniform1i(glGetUniformLocation(program_, "picture"), 0);
    glUniform1i(glGetUniformLocation(program_, "shadow_map"), 1);
}

void Theirs::clear_and_draw(const scene::View& view) {
    const bool depth_only = shading_ == Shading::depth;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    if (inside_)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
    if (shading_ == Shading::shadowed) draw_shadow_map(view);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
    glViewport(0, 0, width_, height_);
    glClearColor(srgb_decode(kBackground.r), srgb_decode(kBackground.g), srgb_decode(kBackground.b),
                 1);
    const auto colour = static_cast<GLboolean>(depth_only ? GL_FALSE : GL_TRUE);
    glColorMask(colour, colour, colour, colour);
    glClear(depth_only ? GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    set_uniforms(view, to_shadow_);
    glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
}

void Theirs::read() {
    if (samples_ > 1) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
        glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
    if (shading_ == Shading::depth)
        glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, read_.data());
    else
        glReadPixels(0, 0, width_, height_, GL_BGRA, GL_UNSIGNED_BYTE, read_.data());
}

void Theirs::draw(const scene::View& view) {
    clear_and_draw(view);
    glFinish();
    read();
}

double Theirs::fragments(const scene::View& view) {
    GLuint query = 0, count = 0;
    glGenQueries(1, &query);
    glUseProgram(program_);
    clear_and_draw(view); // counted below, over a cleared frame
    glClear(GL_DEPTH_BUFFER_BIT);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    glDeleteQueries(1, &query);
    return static_cast<double>(count) / samples_;
}

image::Image Theirs::picture() const {
    image::Image picture(width_, height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const std::uint32_t bgra =
                read_[static_cast<std::size_t>(height_ - 1 - y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)];
            const auto code = [&](int shift) {
                return srgb_encode(static_cast<float>((bgra >> shift) & 255) / 255);
            };
            picture.at(x, y) = {code(16), code(8), code(0), 255};
        }
    return picture;
}

std::vector<float> Theirs::distances(const scene::View& view) const {
    const auto [near, far] = depth_range(view, inside_);
    std::vector<float> distances(read_.size());
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const double depth = std::bit_cast<float>(read_[(height - 1 - y) * width + x]);
            if (depth < 1)
                distances[y * width + x] =
                    static_cast<float>(near * far / (far - depth * (far - near)));
        }
    return distances;
}

} // namespace scanout::bench
