// A name in a file and the line that first gives it.
#pragma once

#include <cstddef>
#include <string>

namespace scanout::io {

struct NameAtLine {
    std::string name;
    std::size_t line = 0;
};

} // namespace scanout::io
