// Result<T>: faults from outside (files, devices, arguments) are values, not exceptions. An Error
// is one finished line for the user: what happened, where (file:line), what to do.
#pragma once

#include "base/exit_code.h"

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include <fmt/format.h>

namespace scanout {

struct Error {
    std::string what;
    Exit exit = Exit::internal;
};

template <class T = void>
using Result = tl::expected<T, Error>;

// fail(Exit::unreadable, "{}:{}: no vertices", path, line): a formatted Error, ready to return.
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(Exit exit, fmt::format_string<Args...> format,
                                         Args&&... args) {
    return tl::unexpected<Error>(Error{fmt::format(format, std::forward<Args>(args)...), exit});
}

} // namespace scanout

#define SCANOUT_CAT2(a, b) a##b
#define SCANOUT_CAT(a, b) SCANOUT_CAT2(a, b)

// TRY(Fd fd, Fd::open(path, O_RDONLY)); declares fd, or returns the error to the caller.
#define TRY(declaration, expression)                                                               \
    SCANOUT_TRY(SCANOUT_CAT(try_result_, __LINE__), declaration, expression)
#define SCANOUT_TRY(result, declaration, expression)                                               \
    auto result = (expression);                                                                    \
    if (!result) return ::tl::unexpected<::scanout::Error>(std::move(result).error());             \
    declaration = *std::move(result)

// TRY_VOID(display.present(frame)); returns the error to the caller, if there is one.
#define TRY_VOID(expression)                                                                       \
    do {                                                                                           \
        auto try_void_result = (expression);                                                       \
        if (!try_void_result)                                                                      \
            return ::tl::unexpected<::scanout::Error>(std::move(try_void_result).error());         \
    } while (false)
