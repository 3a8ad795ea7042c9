// CHECK: our own mistakes end the program at once, with the place and the values (exit 70).
// Faults from outside are Results, never CHECKs.
#pragma once

#include <string>

#include <fmt/format.h>

namespace scanout {

[[noreturn]] void check_failed(const char* file, int line, const char* condition,
                               const std::string& values);

} // namespace scanout

#define CHECK(condition)                                                                           \
    (static_cast<bool>(condition)                                                                  \
         ? void(0)                                                                                 \
         : ::scanout::check_failed(__FILE__, __LINE__, #condition, std::string()))

#define SCANOUT_CHECK_OP(a, op, b)                                                                 \
    do {                                                                                           \
        const auto& check_a = (a);                                                                 \
        const auto& check_b = (b);                                                                 \
        if (!(check_a op check_b))                                                                 \
            ::scanout::check_failed(__FILE__, __LINE__, #a " " #op " " #b,                         \
                                    fmt::format("{} and {}", check_a, check_b));                   \
    } while (false)

#define CHECK_EQ(a, b) SCANOUT_CHECK_OP(a, ==, b)
#define CHECK_LE(a, b) SCANOUT_CHECK_OP(a, <=, b)
#define CHECK_LT(a, b) SCANOUT_CHECK_OP(a, <, b)
#define CHECK_GE(a, b) SCANOUT_CHECK_OP(a, >=, b)
