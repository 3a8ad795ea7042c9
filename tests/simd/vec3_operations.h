// Every operation of simd/vec3-inl.h over one register of operands, on the target that is chosen.
#pragma once

#include "simd/lane_operations.h"

namespace scanout::test {

// x, y and z of every lane. Number: float or double.
template <class Number>
struct Vectors {
    Number x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];
};

template <class Number>
struct Vec3Operands {
    Vectors<Number> a, b;
    Number s[kMaxLanes];
    float row[3], matrix[3][3];
    struct {
        float x, y, z;
    } plain; // as glm names them
};

template <class Number>
struct Vec3Results {
    int lanes; // of a register
    Vectors<Number> sum, difference, product, scaled, sizes, crossed, selected, normalised, turned;
    Vectors<Number> of_row, of_plain, splat;
    Number dot[kMaxLanes], squared[kMaxLanes], length[kMaxLanes], greatest[kMaxLanes];
};

void run_vec3(bool narrow, const Vec3Operands<float>& in, Vec3Results<float>& out);
void run_vec3(const Vec3Operands<double>& in, Vec3Results<double>& out);
// Copies lanes first, first + 1, ... of a structure of arrays; returns how many.
constexpr int kCopied = 3 * kMaxLanes;
int copy_vec3(const float (&from)[3][kCopied], int first, float (&to)[3][kCopied]);

} // namespace scanout::test
