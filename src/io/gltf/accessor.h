// The one way to the bytes of an accessor: whoever holds a View has bytes for all its elements.
// Khronos 2021, 3.6.2: every type of component, normalised, interleaved, sparse, or all zeros.
#pragma once

#include "base/check.h"
#include "base/result.h"
#include "io/gltf/buffers.h"
#include "io/gltf/document.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>

namespace scanout::io::gltf {

int bytes_of(Component component);
inline bool is_index(Component component) { // what for_indices() reads
    return component == Component::u8 || component == Component::u16 || component == Component::u32;
}

// Elements of `rows` components each, at data + i * stride.
struct View {
    const std::uint8_t* data = nullptr;
    std::uint64_t count = 0, stride = 0;
    Component component = Component::f32;
    int rows = 0;
    bool normalized = false;
};

class Accessors {
public:
    Accessors(const Document& document, Buffers& buffers, const std::string& path, Budget& budget)
        : document_(document), buffers_(buffers), path_(path), budget_(budget) {}

    // Fails (Exit::unreadable) with the accessor and the bytes that it lacks. The view is good as
    // long as this object. Matrices are their columns, one after the other.
    Result<View> view(Index accessor);

private:
    Result<View> dense(Index accessor);
    Result<View> sparse(Index accessor);
    Result<View> part(Index accessor, Index view, std::uint64_t offset, std::uint64_t count,
                      Component component, int rows, int columns, bool may_stride);

    const Document& document_;
    Buffers& buffers_;
    const std::string& path_;
    Budget& budget_;
    std::map<Index, Bytes> sparse_;
};

namespace detail {

template <class From, class To>
To component_at(const std::uint8_t* at, bool normalized) {
    From value;
    std::memcpy(&value, at, sizeof value);
    if constexpr (std::is_same_v<From, float>) {
        return static_cast<To>(value);
    } else {
        if (!normalized) return static_cast<To>(value);
        constexpr auto kMost = static_cast<double>(std::numeric_limits<From>::max());
        return static_cast<To>(std::max(static_cast<double>(value) / kMost, -1.0));
    }
}

template <class From, int kRows, class Take>
void each_element(const View& view, Take& take) {
    const std::uint8_t* at = view.data;
    using Number = std::conditional_t<std::is_same_v<From, float>, float, double>;
    for (std::uint64_t i = 0; i < view.count; ++i, at += view.stride) {
        Number element[kRows];
        for (int c = 0; c < kRows; ++c)
            element[c] = component_at<From, Number>(at + c * sizeof(From), view.normalized);
        take(i, element);
    }
}

} // namespace detail

// Calls visit(From()) with the C++ type of a component.
template <class Visit>
void with_type(Component component, Visit&& visit) {
    switch (component) {
    case Component::i8:
        return visit(std::int8_t());
    case Component::u8:
        return visit(std::uint8_t());
    case Component::i16:
        return visit(std::int16_t());
    case Component::u16:
        return visit(std::uint16_t());
    case Component::u32:
        return visit(std::uint32_t());
    case Component::f32:
        return visit(float());
    }
}

// Calls take(i, element) for each, with an array of kRows floats or doubles; the view has as many
// components, or more.
template <int kRows, class Take>
void for_elements(const View& view, Take&& take) {
    CHECK_GE(view.rows, kRows);
    with_type(view.component,
              [&](auto type) { detail::each_element<decltype(type), kRows>(view, take); });
}

// Calls take(i, value) for each element of a view of one unsigned whole number each (is_index).
template <class Take>
void for_indices(const View& view, Take&& take) {
    with_type(view.component, [&](auto type) {
        using From = decltype(type);
        if constexpr (std::is_unsigned_v<From>) {
            const std::uint8_t* at = view.data;
            for (std::uint64_t i = 0; i < view.count; ++i, at += view.stride) {
                From value;
                std::memcpy(&value, at, sizeof value);
                take(i, std::uint32_t{value});
            }
        }
    });
}

} // namespace scanout::io::gltf
