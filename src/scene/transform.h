// The user's transforms of a model, one after the other as they are given [Primer 3.1, 3.2],
// [Compendium 10.5], and what a matrix is made of [Primer 3.3].
#pragma once

#include "math/vec.h"

#include <optional>

namespace scanout::scene {

// p becomes linear (p - c) + c + offset, about a point c.
struct TransformStep {
    DMat3 linear{1};
    DVec3 offset{0};            // bounding radii
    std::optional<DVec3> about; // c, in the file's coordinates; none: the model's centre
};

DMat3 scaling(const DVec3& factors);
// About x first, then y, then z.
DMat3 rotation_xyz(const DVec3& degrees);
// The axis moves by `first` and `second` times the other two, in the order x, y, z: shear-x(dy, dz)
// is x + dy y + dz z.
DMat3 shear(int axis, double first, double second);
// No column is a combination of the others, but for rounding.
bool is_invertible(const DMat3& m);

// The least and the most by which a matrix lengthens anything: its columns' lengths where they
// stand at right angles, as those of a scale and a rotation do, else bounds of them.
struct Stretch {
    double least = 1, most = 1;
};
Stretch stretch_of(const DMat3& m);

// m = rotation * stretch, of a symmetric stretch along three axes at right angles: stretch =
// axes * diagonal(factors) * transpose(axes). A mirrored matrix has factors below 0.
struct Decomposition {
    DMat3 rotation{1};
    DMat3 axes{1}; // columns
    DVec3 factors{1};
    double determinant = 1;
    DVec3 turn_axis{0, 0, 1}; // of the rotation
    double turn_degrees = 0;  // 0 to 180
};
Decomposition polar_decomposition(const DMat3& m); // of an invertible one

} // namespace scanout::scene
