#include "app/picture/composer.h"

#include "app/view/pointer.h"
#include "base/check.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace scanout::app {

image::Rect difference_area(const image::Image& before, const image::Image& after) {
    CHECK_EQ(before.width(), after.width());
    CHECK_EQ(before.height(), after.height());
    image::Rect area{after.width(), after.height(), 0, 0};
    for (int y = 0; y < after.height(); ++y) {
        const auto old_row = before.row(y), new_row = after.row(y);
        if (std::memcmp(old_row.data(), new_row.data(), new_row.size_bytes()) == 0) continue;
        const auto first = std::mismatch(new_row.begin(), new_row.end(), old_row.begin()).first;
        const auto last = std::mismatch(new_row.rbegin(), new_row.rend(), old_row.rbegin()).first;
        area.x0 = std::min(area.x0, static_cast<int>(first - new_row.begin()));
        area.x1 = std::max(area.x1, static_cast<int>(new_row.rend() - last));
        area.y0 = std::min(area.y0, y);
        area.y1 = y + 1;
    }
    return area.empty() ? image::Rect{} : area;
}

Composer::Composer(int width, int height)
    : clean_(width, height), next_(width, height), frame_(width, height) {
    damage_.push_back({0, 0, width, height});
}

void Composer::set_picture(const image::Image& picture,
                           const std::function<void(image::Image&)>& draw_overlay) {
    CHECK_EQ(picture.width(), next_.width());
    CHECK_EQ(picture.height(), next_.height());
    std::transform(picture.pixels().begin(), picture.pixels().end(), next_.pixels().begin(),
                   [](image::Rgba8 pixel) {
                       pixel.a = 255;
                       return pixel;
                   });
    draw_overlay(next_);
    const image::Rect area = difference_area(clean_, next_);
    std::swap(clean_, next_);
    const std::optional<PixelPlace> pointer = pointer_;
    set_pointer(std::nullopt);
    copy_clean(area);
    damage(area);
    set_pointer(pointer);
}

void Composer::set_pointer(std::optional<PixelPlace> pointer) {
    if (pointer == pointer_) return;
    for (const std::optional<PixelPlace>& place : {pointer_, pointer}) {
        if (!place) continue;
        const image::Rect area = pointer_area(place->x, place->y, frame_.width(), frame_.height());
        copy_clean(area);
        damage(area);
    }
    pointer_ = pointer;
    if (pointer_) draw_pointer(frame_, pointer_->x, pointer_->y);
}

const std::vector<image::Rect>& Composer::take_damage() {
    std::swap(damage_, taken_);
    damage_.clear();
    return taken_;
}

void Composer::damage(const image::Rect& area) {
    if (area.empty() || std::find(damage_.begin(), damage_.end(), area) != damage_.end()) return;
    // Frames that are not shown at once pile their damage up: many small ones become one.
    constexpr std::size_t kMax = 8;
    damage_.push_back(area);
    if (damage_.size() <= kMax) return;
    image::Rect all = damage_.front();
    for (const image::Rect& r : damage_)
        all = {std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1),
               std::max(all.y1, r.y1)};
    damage_ = {all};
}

void Composer::copy_clean(const image::Rect& area) {
    for (int y = area.y0; y < area.y1; ++y)
        std::copy_n(clean_.row(y).begin() + area.x0, area.width(), frame_.row(y).begin() + area.x0);
}

} // namespace scanout::app
