#include "io/gltf/accessor.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace scanout::io::gltf {

int bytes_of(Component component) {
    switch (component) {
    case Component::i8:
    case Component::u8:
        return 1;
    case Component::i16:
    case Component::u16:
        return 2;
    default:
        return 4;
    }
}

namespace {

constexpr std::array<std::uint8_t, 64> kZeros{}; // a matrix of sixteen floats

constexpr std::uint64_t kMostElements = std::uint64_t{1} << 40; // times 64 bytes: no overflow

// Columns of matrices begin at multiples of four bytes.
std::uint64_t column_bytes(Component component, int rows, int columns) {
    const auto bytes = static_cast<std::uint64_t>(bytes_of(component) * rows);
    return columns == 1 ? bytes : (bytes + 3) / 4 * 4;
}
// Of an element, without and with what fills its last column.
std::uint64_t element_bytes(Component component, int rows, int columns) {
    return column_bytes(component, rows, columns) * static_cast<std::uint64_t>(columns - 1) +
           static_cast<std::uint64_t>(bytes_of(component) * rows);
}
std::uint64_t packed_bytes(Component component, int rows, int columns) {
    return column_bytes(component, rows, columns) * static_cast<std::uint64_t>(columns);
}

} // namespace

// `count` elements from byte `offset` of a buffer view on. No sum or product here can overflow:
// offsets and counts are at most 2^53 or checked before, strides at most 2^16.
Result<View> Accessors::part(Index accessor, Index view, std::uint64_t offset, std::uint64_t count,
                             Component component, int rows, int columns, bool may_stride) {
    TRY(const ViewBytes bytes, buffers_.view(view));
    const std::uint64_t size = element_bytes(component, rows, columns),
                        packed = packed_bytes(component, rows, columns);
    const std::uint64_t stride = may_stride && bytes.stride != 0 ? bytes.stride : packed;
    const std::uint64_t all = bytes.bytes.size();
    const bool fits = count == 0 || (offset <= all && size <= all - offset &&
                                     count - 1 <= (all - offset - size) / stride);
    if (!fits)
        return fail(Exit::unreadable,
                    "{}: accessors[{}]: {} elements of {} bytes, {} apart, from byte {} on reach "
                    "beyond the {} of bufferViews[{}]",
                    path_, accessor, count, size, stride, offset, all, view);
    return View{
        bytes.bytes.data() + (count == 0 ? 0 : offset), count, stride, component, rows, false};
}

Result<View> Accessors::dense(Index accessor) {
    const Accessor& a = document_.accessors[static_cast<std::size_t>(accessor)];
    if (a.view < 0) return View{kZeros.data(), a.count, 0, a.component, a.rows, a.normalized};
    TRY(View view, part(accessor, a.view, a.offset, a.count, a.component, a.rows, a.columns, true));
    view.normalized = a.normalized;
    return view;
}

// The elements, packed, with those replaced that the accessor says.
Result<View> Accessors::sparse(Index accessor) {
    const Accessor& a = document_.accessors[static_cast<std::size_t>(accessor)];
    const Sparse& s = *a.sparse;
    TRY(View view, dense(accessor));
    const auto done = [&](const Bytes& bytes) {
        view.data = bytes.data();
        view.stride = packed_bytes(a.component, a.rows, a.columns);
        return view;
    };
    if (const auto known = sparse_.find(accessor); known != sparse_.end())
        return done(known->second);
    const std::string what = fmt::format("accessors[{}]", accessor);
    if (s.index_view < 0 || s.value_view < 0 || s.count > a.count || a.count > kMostElements)
        return fail(Exit::unreadable, "{}: {}: its {} sparse elements of {} are not all there",
                    path_, what, s.count, a.count);
    if (!is_index(s.index_type))
        return fail(Exit::unreadable, "{}: {}: its sparse indices are no unsigned whole numbers",
                    path_, what);
    TRY(const View indices,
        part(accessor, s.index_view, s.index_offset, s.count, s.index_type, 1, 1, false));
    TRY(const View values, part(accessor, s.value_view, s.value_offset, s.count, a.component,
                                a.rows, a.columns, false));
    const std::uint64_t size = element_bytes(a.component, a.rows, a.columns),
                        stride = packed_bytes(a.component, a.rows, a.columns);
    TRY_VOID(budget_.take(a.count * stride, what));
    Bytes bytes(a.count * stride);
    for (std::uint64_t i = 0; i < a.count && a.view >= 0; ++i)
        std::memcpy(bytes.data() + i * stride, view.data + i * view.stride, size);
    std::optional<std::uint32_t> beyond;
    for_indices(indices, [&](std::uint64_t i, std::uint32_t to) {
        if (to >= a.count)
            beyond = beyond.value_or(to);
        else
            std::memcpy(bytes.data() + to * stride, values.data + i * values.stride, size);
    });
    if (beyond)
        return fail(Exit::unreadable, "{}: {}: a sparse index is {}, and there are {} elements",
                    path_, what, *beyond, a.count);
    return done(sparse_.emplace(accessor, std::move(bytes)).first->second);
}

Result<View> Accessors::view(Index accessor) {
    const Accessor& a = document_.accessors[static_cast<std::size_t>(accessor)];
    if (!a.fault.empty())
        return fail(Exit::unreadable, "{}: accessors[{}].{}", path_, accessor, a.fault);
    return a.sparse ? sparse(accessor) : dense(accessor);
}

} // namespace scanout::io::gltf
