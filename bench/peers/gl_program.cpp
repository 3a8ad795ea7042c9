#include "bench/peers/gl_program.h"

#include <array>

namespace scanout::bench {
namespace {

// Light in view space, where the eye is the origin: linear, clamped by what it is written into.
constexpr const char* kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 to_clip, to_view, to_shadow;
uniform mat3 normal_to_view;
#ifdef LIGHT
out vec3 view_normal, view_position;
#endif
#ifdef TEXTURE
out vec2 texel;
#endif
#ifdef SHADOW
out vec3 shadow_place;
#endif
void main() {
    gl_Position = to_clip * vec4(position, 1.0);
#ifdef LIGHT
    view_normal = normal_to_view * normal;
    view_position = (to_view * vec4(position, 1.0)).xyz;
#endif
#ifdef TEXTURE
    texel = uv;
#endif
#ifdef SHADOW
    shadow_place = (to_shadow * vec4(position, 1.0)).xyz;
#endif
}
)";

constexpr const char* kFragment = R"(
#ifdef LIGHT
uniform vec3 to_light, diffuse, specular;
uniform float ambient, shininess;
in vec3 view_normal, view_position;
out vec4 colour;
#endif
#ifdef TEXTURE
uniform sampler2D picture;
in vec2 texel;
#endif
#ifdef SHADOW
uniform sampler2DShadow shadow_map;
in vec3 shadow_place;
#endif
void main() {
#ifdef LIGHT
    vec3 n = normalize(view_normal);
#ifdef TWO_SIDED
    if (!gl_FrontFacing) n = -n;
#endif
    vec3 h = normalize(to_light + normalize(-view_position));
    float facing = max(dot(n, to_light), 0.0);
    float highlight = pow(max(dot(n, h), 0.0), shininess);
    vec3 albedo = diffuse;
#ifdef TEXTURE
    albedo = texture(picture, texel).rgb;
#endif
    float lit = 1.0;
#ifdef SHADOW
    lit = texture(shadow_map, shadow_place);
#endif
    colour = vec4(ambient * albedo + lit * (albedo * facing + specular * highlight), 1.0);
#endif
}
)";

Result<GLuint> compile(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint fine = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
    if (fine != 0) return shader;
    std::array<char, 2048> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    return fail(Exit::internal, "a shader does not compile: {}", log.data());
}

} // namespace

Result<GLuint> make_program(const GlFeatures& features) {
    std::string head = "#version 330 core\n";
    if (features.light) head += "#define LIGHT\n";
    if (features.texture) head += "#define TEXTURE\n";
    if (features.shadow) head += "#define SHADOW\n";
    if (features.two_sided) head += "#define TWO_SIDED\n";
    TRY(const GLuint vertex, compile(GL_VERTEX_SHADER, head + kVertex));
    TRY(const GLuint fragment, compile(GL_FRAGMENT_SHADER, head + kFragment));
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint fine = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &fine);
    if (fine == 0) return fail(Exit::internal, "the shaders do not link");
    return program;
}

} // namespace scanout::bench
