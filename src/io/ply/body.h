// The body of a PLY file, row by row, in any encoding: a row is the numbers of one element.
#pragma once

#include "base/jobs.h"
#include "io/cursor.h"
#include "io/ply/header.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

// One row; a scalar property is a list of one value. Integers of 32 bits are exact in double.
struct PlyRow {
    std::vector<double> values;
    std::vector<std::size_t> begin; // of each property's values; one entry more than properties

    std::span<const double> list(std::size_t property) const {
        return {values.data() + begin[property], begin[property + 1] - begin[property]};
    }
    double scalar(std::size_t property) const { return values[begin[property]]; }
};

enum class PlyRowState {
    good,
    bad, // this row alone cannot be read: fault() says why
    end, // nor can any behind it: fault() says why
};

class PlyBody {
public:
    PlyBody(std::string_view file, const PlyHeader& header);

    // Reads the next row. Rows must be asked for in the order of the header's elements.
    PlyRowState next(const PlyElement& element, PlyRow& row);

    // Rows of an element without lists in a binary body, as many as are there, all at once: calls
    // row(index, values) from all threads, the values in the order of the properties. Returns how
    // many there were.
    template <class Function>
    std::size_t each_of_fixed_size(const PlyElement& element, Jobs& jobs, Function&& row);

    // Rows of a binary body whose lists are as long as those of the next row: how many follow each
    // other, at most `most`, and where in one of them a property's values stand. None at the end.
    struct EqualRows {
        const char* first = nullptr;
        std::size_t count = 0, row_bytes = 0;
        std::vector<std::size_t> offset, length; // of each property's values; 1 of a scalar
    };
    EqualRows equal_rows(const PlyElement& element, std::size_t most, Jobs& jobs) const;
    void skip_rows(const EqualRows& rows, std::size_t count) { at_.at += count * rows.row_bytes; }

    bool is_big_endian() const { return encoding_ == PlyEncoding::big_endian; }
    bool is_binary() const { return encoding_ != PlyEncoding::ascii; }
    const std::string& fault() const { return fault_; }
    std::size_t line() const { return line_; }      // of the row that was read last; ASCII only
    bool had_more_numbers() const { return more_; } // behind a row's last one; ASCII only
    std::size_t position() const { return static_cast<std::size_t>(at_.at - begin_); }

private:
    PlyRowState next_ascii(const PlyElement& element, PlyRow& row);
    PlyRowState next_binary(const PlyElement& element, PlyRow& row);
    bool ascii_number(double& value);
    // Appends `count` values at the cursor, which must lie in the file.
    void decode(PlyType type, std::size_t count, std::vector<double>& values);
    std::size_t bytes_left() const { return static_cast<std::size_t>(at_.end - at_.at); }
    std::size_t fixed_rows(const PlyElement& element) const;

    const char* begin_;
    PlyEncoding encoding_;
    Cursor at_;
    std::string fault_;
    std::size_t line_ = 0;
    bool more_ = false;
};

inline void keep_least(std::atomic<std::size_t>& least, std::size_t value) {
    for (std::size_t now = least; value < now && !least.compare_exchange_weak(now, value);) {
    }
}

// Decodes `count` values of a binary body.
void decode_ply(PlyType type, bool big_endian, const char* bytes, std::size_t count, double* out);

} // namespace scanout::io

#include "base/chunks.h"

namespace scanout::io {

template <class Function>
std::size_t PlyBody::each_of_fixed_size(const PlyElement& element, Jobs& jobs, Function&& row) {
    constexpr std::size_t kChunk = 4096;
    const std::size_t row_bytes = element.least_row_bytes(), rows = fixed_rows(element);
    const char* first = at_.at;
    for_chunks(jobs, rows, kChunk, [&](std::size_t begin, std::size_t end, int) {
        std::vector<double> values(element.properties.size());
        for (std::size_t i = begin; i < end; ++i) {
            const char* bytes = first + i * row_bytes;
            for (std::size_t p = 0; p < values.size(); ++p) {
                const PlyType type = element.properties[p].type;
                decode_ply(type, encoding_ == PlyEncoding::big_endian, bytes, 1, &values[p]);
                bytes += size_of(type);
            }
            row(i, values);
        }
    });
    at_.at += rows * row_bytes;
    return rows;
}

} // namespace scanout::io
