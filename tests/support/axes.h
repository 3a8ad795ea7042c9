// Every axis with the names of its techniques, as src/techniques.h lists them.
#pragma once

#include "techniques.h"

#include <string>
#include <utility>
#include <vector>

namespace scanout::test {

using Names = std::vector<std::string>;

inline const std::vector<std::pair<std::string, Names>>& axes() {
#define SCANOUT_NAME(name) #name,
#define SCANOUT_NAMES(module, axis, LIST, Row, choice, help) {#axis, {LIST(SCANOUT_NAME)}},
    static const std::vector<std::pair<std::string, Names>> all = {SCANOUT_AXES(SCANOUT_NAMES)};
#undef SCANOUT_NAME
#undef SCANOUT_NAMES
    return all;
}

inline const Names& names_on(const std::string& axis) {
    static const Names none;
    for (const auto& [name, names] : axes())
        if (name == axis) return names;
    return none;
}

} // namespace scanout::test
