// Warnock 1969 [Primer 5.3.3]: a window that no face meets is empty; one that a single face meets
// is drawn; one that a face covers in front of all others shows that face; any other is cut in
// four, down to a pixel, where depths decide.
#include "textbook/hidden/hidden.h"

#include <algorithm>

namespace scanout::textbook {
namespace {

struct Window {
    int x0, y0, x1, y1; // pixels x0 <= x < x1, y0 <= y < y1
    bool is_pixel() const { return x1 - x0 == 1 && y1 - y0 == 1; }
    std::array<DVec2, 4> corners() const {
        return {DVec2(x0, y0), DVec2(x1 - 1, y0), DVec2(x0, y1 - 1), DVec2(x1 - 1, y1 - 1)};
    }
};
using Faces = std::vector<const Triangle*>;

// All of the window lies on the outer side of an edge. With a margin, for what is rounded.
bool misses(const Triangle& t, const Window& w) {
    Points p = points_of(t);
    const double area = twice_area(p[0], p[1], p[2]);
    if (area < 0) std::swap(p[1], p[2]);
    const auto corners = w.corners();
    for (std::size_t i = 0; i < 3; ++i)
        if (std::all_of(corners.begin(), corners.end(), [&](const DVec2& c) {
                return twice_area(p[i], p[(i + 1) % 3], c) <
                       -1e-6 * (1 + (area < 0 ? -area : area));
            }))
            return true;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    return right < w.x0 || left > w.x1 - 1 || bottom < w.y0 || top > w.y1 - 1;
}

bool surrounds(const Triangle& t, const Window& w) {
    const auto corners = w.corners();
    return std::all_of(corners.begin(), corners.end(),
                       [p = points_of(t)](const DVec2& c) { return covers(p, c.x, c.y); });
}

// At every corner nearer than the planes of all others: then everywhere in the window.
bool in_front(const Triangle& t, const Faces& faces, const Window& w) {
    const auto corners = w.corners();
    return std::all_of(faces.begin(), faces.end(), [&](const Triangle* other) {
        return other == &t || std::all_of(corners.begin(), corners.end(), [&](const DVec2& c) {
                   const int x = static_cast<int>(c.x), y = static_cast<int>(c.y);
                   return depth_on_screen(t, x, y) < depth_on_screen(*other, x, y);
               });
    });
}

class Warnock {
public:
    explicit Warnock(const Shade& shade) : shade_(shade) {}
    void draw(const Window& w, const Faces& above) {
        Faces faces;
        std::copy_if(above.begin(), above.end(), std::back_inserter(faces),
                     [&](const Triangle* t) { return !misses(*t, w); });
        if (faces.empty()) return;
        if (faces.size() == 1) return draw_face(*faces.front(), w);
        for (const Triangle* t : faces)
            if (surrounds(*t, w) && in_front(*t, faces, w)) return draw_face(*t, w);
        if (w.is_pixel()) return draw_pixel(faces, w.x0, w.y0);
        const int x = (w.x0 + w.x1 + 1) / 2, y = (w.y0 + w.y1 + 1) / 2;
        for (const Window& part : {Window{w.x0, w.y0, x, y}, Window{x, w.y0, w.x1, y},
                                   Window{w.x0, y, x, w.y1}, Window{x, y, w.x1, w.y1}})
            if (part.x0 < part.x1 && part.y0 < part.y1) draw(part, faces);
    }

private:
    void draw_face(const Triangle& t, const Window& w) {
        const Points p = points_of(t);
        for (int y = w.y0; y < w.y1; ++y)
            for_each_run(
                w.x0, w.x1, [&](int x) { return covers(p, x, y); },
                [&](int from, int end) { shade_(t, y, from, end); });
    }
    void draw_pixel(const Faces& faces, int x, int y) {
        const Triangle* nearest = nullptr;
        for (const Triangle* t : faces)
            if (covers(points_of(*t), x, y) &&
                (nearest == nullptr || depth_on_screen(*t, x, y) < depth_on_screen(*nearest, x, y)))
                nearest = t;
        if (nearest != nullptr) shade_(*nearest, y, x, x + 1);
    }

    const Shade& shade_;
};

} // namespace

void hidden_warnock(const HiddenTask& task, const Shade& shade) {
    Faces all;
    for (const Triangle& t : task.triangles)
        if (twice_area(points_of(t)[0], points_of(t)[1], points_of(t)[2]) != 0) all.push_back(&t);
    Warnock(shade).draw({0, 0, task.width, task.height}, all);
}

} // namespace scanout::textbook
