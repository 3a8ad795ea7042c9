#include "geom/point_grid.h"

namespace scanout::geom {

PointGrid::PointGrid(std::span<const DVec2> points, std::span<const std::uint32_t> members) {
    DVec2 hi(0);
    if (!members.empty()) origin_ = hi = points[members[0]];
    for (const std::uint32_t i : members) {
        origin_ = {std::min(origin_.x, points[i].x), std::min(origin_.y, points[i].y)};
        hi = {std::max(hi.x, points[i].x), std::max(hi.y, points[i].y)};
    }
    while (side_ < 1024 && index(0, side_) * 4 < members.size())
        side_ *= 2;
    per_unit_ = {hi.x > origin_.x ? side_ / (hi.x - origin_.x) : 0,
                 hi.y > origin_.y ? side_ / (hi.y - origin_.y) : 0};

    const auto cell = [&](std::uint32_t i) {
        const DVec2 p = to_grid(points[i]);
        return index(cell_of(p.x), cell_of(p.y));
    };
    begin_.assign(index(0, side_), 0);
    count_.assign(begin_.size(), 0);
    points_.resize(members.size() + 1); // + 1: an empty last cell has an address too
    for (const std::uint32_t i : members)
        ++count_[cell(i)];
    for (std::size_t i = 1; i < begin_.size(); ++i)
        begin_[i] = begin_[i - 1] + count_[i - 1];
    std::fill(count_.begin(), count_.end(), 0);
    for (const std::uint32_t i : members)
        points_[begin_[cell(i)] + count_[cell(i)]++] = i;
}

PointGrid::Range PointGrid::columns_in_row(const DVec2 (&corners)[3], int row) const {
    // Points outside the grid's box are in its outermost cells, so the outermost rows have no end.
    // The margin is far above the rounding of the sums below.
    constexpr double kMargin = 1e-3, kFar = 1e300;
    const double bottom = row == 0 ? -kFar : row - kMargin;
    const double top = row == side_ - 1 ? kFar : row + 1 + kMargin;
    double lo = kFar, hi = -kFar;
    for (int i = 0; i < 3; ++i) {
        const DVec2 &p = corners[i], &q = corners[(i + 1) % 3];
        if (std::min(p.y, q.y) > top || std::max(p.y, q.y) < bottom) continue;
        for (const double y : {std::clamp(p.y, bottom, top), std::clamp(q.y, bottom, top)}) {
            const double t = q.y == p.y ? 0 : std::clamp((y - p.y) / (q.y - p.y), 0.0, 1.0);
            const double x = y == p.y ? p.x : y == q.y ? q.x : p.x + t * (q.x - p.x);
            lo = std::min(lo, x);
            hi = std::max(hi, x);
        }
    }
    return {std::max(cell_of(lo) - 1, 0), std::min(cell_of(hi) + 1, side_ - 1)};
}

} // namespace scanout::geom
