#include "base/warnings.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout {

void Warnings::add(std::string_view kind, std::string line) {
    const auto found =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.name == kind; });
    if (found == kinds_.end())
        kinds_.push_back({std::string(kind), std::move(line), 1});
    else
        ++found->count;
}

void Warnings::add_more(std::string_view kind, std::size_t count) {
    for (Kind& k : kinds_)
        if (k.name == kind) k.count += count;
}

std::size_t Warnings::count(std::string_view kind) const {
    for (const Kind& k : kinds_)
        if (k.name == kind) return k.count;
    return 0;
}

std::vector<std::string> Warnings::lines() const {
    std::vector<std::string> lines;
    for (const Kind& k : kinds_)
        lines.push_back(k.count > 1
                            ? fmt::format("{} (and {} more like it)", k.first_line, k.count - 1)
                            : k.first_line);
    return lines;
}

} // namespace scanout
