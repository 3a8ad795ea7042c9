// Points of the plane in square cells, to find the points near a triangle quickly: ear clipping
// then need not test every corner against every ear.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

class PointGrid {
public:
    // Holds the points with the numbers `members`, about four in a cell.
    PointGrid(std::span<const DVec2> points, std::span<const std::uint32_t> members);

    enum class Visit { go_on, forget, stop }; // forget: this point is never visited again

    // Visits every point within the triangle or on its border, and some near it, until one visit
    // says stop. Returns false then. `work` grows by the number of cells and points looked at.
    template <class Visitor>
    bool visit(const DVec2& a, const DVec2& b, const DVec2& c, std::uint64_t& work,
               Visitor&& visitor) {
        const DVec2 corners[3] = {to_grid(a), to_grid(b), to_grid(c)};
        const int last = cell_of(std::max({corners[0].y, corners[1].y, corners[2].y}));
        for (int row = cell_of(std::min({corners[0].y, corners[1].y, corners[2].y})); row <= last;
             ++row) {
            const Range columns = columns_in_row(corners, row);
            for (int column = columns.first; column <= columns.last; ++column)
                if (!visit_cell(index(column, row), work, visitor)) return false;
        }
        return true;
    }

private:
    struct Range {
        int first, last;
    };
    // The columns that the triangle covers in a row of cells, and one more at either side.
    Range columns_in_row(const DVec2 (&corners)[3], int row) const;

    template <class Visitor>
    bool visit_cell(std::size_t cell, std::uint64_t& work, Visitor&& visitor) {
        std::uint32_t* const points = &points_[begin_[cell]];
        std::uint32_t& count = count_[cell];
        work += count + 1;
        for (std::uint32_t i = 0; i < count;) {
            switch (visitor(points[i])) {
            case Visit::go_on:
                ++i;
                break;
            case Visit::forget:
                points[i] = points[--count];
                break;
            case Visit::stop:
                return false;
            }
        }
        return true;
    }

    // Monotone in x and y: a point between two others lies in a cell between theirs.
    DVec2 to_grid(const DVec2& p) const { return (p - origin_) * per_unit_; }
    int cell_of(double t) const {
        return t >= side_ ? side_ - 1 : t >= 0 ? static_cast<int>(t) : 0;
    }
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
               static_cast<std::size_t>(column);
    }

    int side_ = 1; // the grid has side_ x side_ cells
    DVec2 origin_{0}, per_unit_{0};
    std::vector<std::uint32_t> begin_, count_; // of each cell, in points_
    std::vector<std::uint32_t> points_;
};

} // namespace scanout::geom
