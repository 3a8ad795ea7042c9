// The oracle of coverage: exact integers of 128 bits, and no tie rule at all. It shares no code
// with the renderer. A sample that the top-left rule puts inside is one that lies inside after it
// has moved by an infinitely small step to the right and a still smaller one down, so that is what
// is computed: coordinates are scaled by 2^62 and the sample moved by (2^31, 1), which no edge that
// misses the sample can notice (its function is at least 2^62 there; while coordinates stay within
// 2^21 pixels the step changes it by less than 2^62).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace scanout::oracle {

__extension__ typedef __int128 Int128;

inline constexpr std::int32_t kUnitsPerPixel = 256;

struct Corner {
    std::int32_t x, y; // 1/256 pixel
    friend bool operator==(const Corner&, const Corner&) = default;
};
using Corners = std::array<Corner, 3>;

// Twice the signed area of a, b and the point; exact.
inline Int128 cross(const Corner& a, const Corner& b, std::int64_t x, std::int64_t y) {
    return (Int128{b.x} - a.x) * (Int128{y} - a.y) - (Int128{b.y} - a.y) * (Int128{x} - a.x);
}
inline Int128 area(const Corners& v) {
    return cross(v[0], v[1], v[2].x, v[2].y);
}

class ExactTriangle {
public:
    explicit ExactTriangle(const Corners& v) {
        const Int128 whole = area(v);
        empty_ = whole == 0;
        for (std::size_t i = 0; i < 3; ++i) {
            from_[i] = v[i];
            to_[i] = v[(i + 1) % 3];
            if (whole < 0) std::swap(from_[i], to_[i]);
        }
    }
    bool covers(std::int64_t x, std::int64_t y) const { return inside(at(x, y)); }

    // The scaled edge functions, and what they change by from one pixel to the next.
    std::array<Int128, 3> at(std::int64_t x, std::int64_t y) const {
        std::array<Int128, 3> e;
        for (std::size_t i = 0; i < 3; ++i) {
            const Int128 dx = Int128{to_[i].x} - from_[i].x, dy = Int128{to_[i].y} - from_[i].y;
            const Int128 px = (Int128{x} - from_[i].x) * kScale + (Int128{1} << 31);
            const Int128 py = (Int128{y} - from_[i].y) * kScale + 1;
            e[i] = dx * py - dy * px;
        }
        return e;
    }
    void step_right(std::array<Int128, 3>& e) const {
        for (std::size_t i = 0; i < 3; ++i)
            e[i] -= (Int128{to_[i].y} - from_[i].y) * kScale * kUnitsPerPixel;
    }
    bool inside(const std::array<Int128, 3>& e) const {
        return !empty_ && e[0] > 0 && e[1] > 0 && e[2] > 0;
    }

private:
    static constexpr Int128 kScale = Int128{1} << 62;
    std::array<Corner, 3> from_, to_;
    bool empty_;
};

} // namespace scanout::oracle
