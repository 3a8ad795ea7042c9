// Every row of every axis, as techniques.h lists them: scanout::<module>::<axis>::kRows. A name
// without a row is a link error.
#pragma once

#include "techniques.h"

#include <span>
#include <string_view>

#define SCANOUT_EXTERN(name) extern const Row name;
#define SCANOUT_ADDRESS(name) &name,
#define SCANOUT_DECLARE(module, axis, LIST, Type, choice, help)                                    \
    namespace scanout::module {                                                                    \
    struct Type;                                                                                   \
    namespace axis {                                                                               \
    using Row = Type;                                                                              \
    LIST(SCANOUT_EXTERN)                                                                           \
    inline constexpr const Row* kRows[] = {LIST(SCANOUT_ADDRESS)};                                 \
    }                                                                                              \
    }
SCANOUT_AXES(SCANOUT_DECLARE)
#undef SCANOUT_EXTERN
#undef SCANOUT_ADDRESS
#undef SCANOUT_DECLARE

namespace scanout {

// The row of this name; null where there is none.
template <class Row, std::size_t kCount>
const Row* find_row(const Row* const (&rows)[kCount], std::string_view name) {
    for (const Row* row : rows)
        if (row->card.name == name) return row;
    return nullptr;
}

// The same; another one where there is none.
template <class Row, std::size_t kCount>
const Row& row_or(const Row* const (&rows)[kCount], std::string_view name, const Row& other) {
    const Row* found = find_row(rows, name);
    return found != nullptr ? *found : other;
}

} // namespace scanout
