// The extensions of glTF that are drawn, and what is said of the others.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/document.h"

#include <string>

namespace scanout::io::gltf {

// An extension that the file requires and that is not known is an error (Exit::unreadable). Those
// that are left out, because no more than looks hangs on them or the file only uses them, are one
// warning.
Result<> check_extensions(const Document& document, const std::string& path, Warnings& warnings);

} // namespace scanout::io::gltf
