// Vectors and matrices: GLM, packed (no SIMD), column vectors, right-handed. Only constructors and
// + - * / of GLM stand in code that decides a pixel; no glm function that calls libm
// (HARD-CASES D2).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace scanout {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;
using DVec4 = glm::dvec4;
using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;

// One fixed order of additions, so that every compiler gives the same bits.
template <class V>
inline typename V::value_type dot3(const V& a, const V& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class V>
inline V cross3(const V& a, const V& b) {
    return V(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

} // namespace scanout
