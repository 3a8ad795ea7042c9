#include "io/ply/body.h"

#include "io/text.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

std::uint16_t swapped(std::uint16_t bits) {
    return __builtin_bswap16(bits);
}
std::uint32_t swapped(std::uint32_t bits) {
    return __builtin_bswap32(bits);
}
std::uint64_t swapped(std::uint64_t bits) {
    return __builtin_bswap64(bits);
}

template <class T, class Bits>
void decode_as(bool big_endian, const char* bytes, std::size_t count, double* out) {
    for (std::size_t i = 0; i < count; ++i, bytes += sizeof(Bits)) {
        Bits bits = 0;
        std::memcpy(&bits, bytes, sizeof(Bits));
        if (big_endian != (std::endian::native == std::endian::big)) bits = swapped(bits);
        out[i] = static_cast<double>(std::bit_cast<T>(bits));
    }
}

template <class T>
void decode_byte(const char* bytes, std::size_t count, double* out) {
    for (std::size_t i = 0; i < count; ++i)
        out[i] = static_cast<double>(static_cast<T>(bytes[i]));
}

} // namespace

void decode_ply(PlyType type, bool big_endian, const char* bytes, std::size_t count, double* out) {
    switch (type) {
    case PlyType::int8:
        return decode_byte<std::int8_t>(bytes, count, out);
    case PlyType::uint8:
        return decode_byte<std::uint8_t>(bytes, count, out);
    case PlyType::int16:
        return decode_as<std::int16_t, std::uint16_t>(big_endian, bytes, count, out);
    case PlyType::uint16:
        return decode_as<std::uint16_t, std::uint16_t>(big_endian, bytes, count, out);
    case PlyType::int32:
        return decode_as<std::int32_t, std::uint32_t>(big_endian, bytes, count, out);
    case PlyType::uint32:
        return decode_as<std::uint32_t, std::uint32_t>(big_endian, bytes, count, out);
    case PlyType::float32:
        return decode_as<float, std::uint32_t>(big_endian, bytes, count, out);
    case PlyType::float64:
        return decode_as<double, std::uint64_t>(big_endian, bytes, count, out);
    }
}

PlyBody::PlyBody(std::string_view file, const PlyHeader& header)
    : begin_(file.data()), encoding_(header.encoding), at_(file) {
    at_.at += header.body;
    at_.line = header.body_line;
}

PlyRowState PlyBody::next(const PlyElement& element, PlyRow& row) {
    row.values.clear();
    row.begin.clear();
    return is_binary() ? next_binary(element, row) : next_ascii(element, row);
}

// --- Binary

void PlyBody::decode(PlyType type, std::size_t count, std::vector<double>& values) {
    const std::size_t size = values.size();
    values.resize(size + count);
    decode_ply(type, encoding_ == PlyEncoding::big_endian, at_.at, count, values.data() + size);
    at_.at += count * size_of(type);
}

PlyRowState PlyBody::next_binary(const PlyElement& element, PlyRow& row) {
    for (const PlyProperty& property : element.properties) {
        row.begin.push_back(row.values.size());
        std::size_t count = 1;
        if (property.list_length_type) {
            double length = 0;
            if (bytes_left() < size_of(*property.list_length_type)) {
                fault_ = "the file ends";
                return PlyRowState::end;
            }
            decode_ply(*property.list_length_type, encoding_ == PlyEncoding::big_endian, at_.at, 1,
                       &length);
            at_.at += size_of(*property.list_length_type);
            if (length < 0) {
                fault_ = fmt::format("a list has {} entries", length);
                return PlyRowState::end;
            }
            count = static_cast<std::size_t>(length);
        }
        if (count > bytes_left() / size_of(property.type)) {
            fault_ = "the file ends";
            return PlyRowState::end;
        }
        decode(property.type, count, row.values);
    }
    row.begin.push_back(row.values.size());
    return PlyRowState::good;
}

PlyBody::EqualRows PlyBody::equal_rows(const PlyElement& element, std::size_t most,
                                       Jobs& jobs) const {
    constexpr std::size_t kChunk = 8192, kMostBytes = 4096; // of a row
    struct ListLength {
        std::size_t offset, bytes;
    };
    EqualRows rows;
    std::vector<ListLength> lists;
    const std::size_t left = std::min(bytes_left(), kMostBytes);
    for (const PlyProperty& property : element.properties) {
        double length = 1;
        if (property.list_length_type) {
            const std::size_t bytes = size_of(*property.list_length_type);
            if (bytes > left - rows.row_bytes) return {};
            decode_ply(*property.list_length_type, is_big_endian(), at_.at + rows.row_bytes, 1,
                       &length);
            lists.push_back({rows.row_bytes, bytes});
            rows.row_bytes += bytes;
        }
        const std::size_t room = (left - rows.row_bytes) / size_of(property.type);
        if (!(length >= 0 && length <= static_cast<double>(room))) return {};
        rows.offset.push_back(rows.row_bytes);
        rows.length.push_back(static_cast<std::size_t>(length));
        rows.row_bytes += rows.length.back() * size_of(property.type);
    }
    if (rows.row_bytes == 0) return {};
    rows.first = at_.at;
    std::atomic<std::size_t> equal{std::min(most, bytes_left() / rows.row_bytes)};
    for_chunks(jobs, equal, kChunk, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            for (const ListLength& list : lists)
                if (std::memcmp(rows.first + i * rows.row_bytes + list.offset,
                                rows.first + list.offset, list.bytes) != 0)
                    return keep_least(equal, i);
    });
    rows.count = equal;
    return rows;
}

std::size_t PlyBody::fixed_rows(const PlyElement& element) const {
    const std::size_t bytes = element.least_row_bytes();
    if (bytes == 0) return 0;
    return static_cast<std::size_t>(std::min<std::uint64_t>(element.count, bytes_left() / bytes));
}

// --- ASCII: a row is a line

bool PlyBody::ascii_number(double& value) {
    at_.skip_blanks();
    if (at_.at_line_end()) {
        fault_ = "the line ends too early";
        return false;
    }
    switch (at_.number(value)) {
    case NumberFault::none:
        return true;
    case NumberFault::too_large:
        value = std::numeric_limits<double>::infinity();
        at_.word();
        return true;
    case NumberFault::not_a_number:
        break;
    }
    fault_ = fmt::format("'{}' is not a finite number", shown(at_.word()));
    return false;
}

PlyRowState PlyBody::next_ascii(const PlyElement& element, PlyRow& row) {
    for (at_.skip_blanks(); !at_.done() && at_.at_line_end(); at_.skip_blanks())
        at_.next_line();
    line_ = at_.line;
    more_ = false;
    if (at_.done()) {
        fault_ = "the file ends";
        return PlyRowState::end;
    }
    const auto bad = [&] {
        at_.skip_to_line_end(bytes_left());
        at_.next_line();
        return PlyRowState::bad;
    };
    for (const PlyProperty& property : element.properties) {
        row.begin.push_back(row.values.size());
        double length = 1, value = 0;
        if (property.list_length_type) {
            at_.skip_blanks();
            if (at_.at_line_end()) // the header has a list that no row has
                length = 0;
            else if (!ascii_number(length))
                return bad();
            if (!(length >= 0 && length <= static_cast<double>(bytes_left()))) {
                fault_ = fmt::format("a list of {} entries", length);
                return bad();
            }
        }
        for (std::size_t i = static_cast<std::size_t>(length); i > 0; --i) {
            if (!ascii_number(value)) return bad();
            row.values.push_back(value);
        }
    }
    row.begin.push_back(row.values.size());
    at_.skip_blanks();
    more_ = !at_.at_line_end();
    at_.skip_to_line_end(bytes_left());
    at_.next_line();
    return PlyRowState::good;
}

} // namespace scanout::io
