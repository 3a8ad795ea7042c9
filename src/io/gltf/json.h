// JSON text of a glTF file -> Document, by simdjson. Its one reader: nothing else sees the JSON.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/document.h"

#include <string>
#include <string_view>

namespace scanout::io::gltf {

// A matrix of a translation, then a rotation (a quaternion x, y, z, w of any length; 0: none), then
// a scale; the scale is applied first.
DMat4 trs_matrix(const DVec3& translation, const double* rotation, const DVec3& scale);

// An error (Exit::unreadable) names the first place that cannot be meant, such as
// "accessors[3].count"; so does a reference beyond the end of its array. References to materials,
// textures, images and samplers that are not there are warnings, and none. Where nothing moves,
// only the names of animations are read.
Result<Document> read_document(std::string_view json, const std::string& path, Warnings& warnings,
                               bool moves);

} // namespace scanout::io::gltf
