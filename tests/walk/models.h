// Small models that a walk draws beside those that are shipped: bodies with normals of their own,
// and files that no artist would write.
#pragma once

#include <filesystem>

namespace scanout::test {

void write_walk_models(const std::filesystem::path& folder);

} // namespace scanout::test
