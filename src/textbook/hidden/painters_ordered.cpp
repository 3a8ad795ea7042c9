// The painter's algorithm with an order that is right wherever there is one: of two faces that meet
// at a pixel the farther one is drawn first, whatever their middles say (after Newell et al. 1972,
// who compare planes and cut faces where they must; here pixels are compared, and a
// ring of faces is cut open at the one whose middle is farthest; never at a face that only waits
// behind a ring).
#include "textbook/hidden/hidden.h"

#include <algorithm>
#include <queue>

namespace scanout::textbook {
namespace {

struct Fragment {
    double depth;
    std::size_t triangle;
};

// pixel -> what covers it, from far to near; of equal depths the first of the file last, on top.
std::vector<std::vector<Fragment>> fragments_of(const HiddenTask& task) {
    std::vector<std::vector<Fragment>> pixels(static_cast<std::size_t>(task.width) *
                                              static_cast<std::size_t>(task.height));
    for (std::size_t i = 0; i < task.triangles.size(); ++i)
        fill_in_picture(task, task.triangles[i], [&](int y, int x0, int x1) {
            for (int x = x0; x < x1; ++x)
                pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(task.width) +
                       static_cast<std::size_t>(x)]
                    .push_back({depth_on_screen(task.triangles[i], x, y), i});
        });
    for (std::vector<Fragment>& pixel : pixels)
        std::sort(pixel.begin(), pixel.end(), [](const Fragment& a, const Fragment& b) {
            return a.depth != b.depth ? a.depth > b.depth : a.triangle > b.triangle;
        });
    return pixels;
}

class Order {
public:
    explicit Order(const HiddenTask& task)
        : before_(task.triangles.size()), waits_(before_.size()) {
        for (const std::vector<Fragment>& pixel : fragments_of(task))
            for (std::size_t i = 0; i + 1 < pixel.size(); ++i)
                if (pixel[i].triangle != pixel[i + 1].triangle)
                    before_[pixel[i].triangle].push_back(pixel[i + 1].triangle);
        for (std::vector<std::size_t>& after : before_) {
            std::sort(after.begin(), after.end());
            after.erase(std::unique(after.begin(), after.end()), after.end());
            for (const std::size_t t : after)
                ++waits_[t];
        }
    }
    // From far to near (Kahn 1962).
    std::vector<std::size_t> sorted(const std::vector<std::size_t>& by_distance) {
        std::vector<std::size_t> order;
        std::vector<bool> drawn(before_.size(), false);
        std::queue<std::size_t> free;
        const auto draw = [&](std::size_t t) {
            drawn[t] = true;
            order.push_back(t);
            for (const std::size_t after : before_[t])
                if (--waits_[after] == 0 && !drawn[after]) free.push(after);
        };
        for (const std::size_t t : by_distance)
            if (waits_[t] == 0) free.push(t);
        for (;;) {
            for (; !free.empty(); free.pop())
                draw(free.front());
            if (order.size() == before_.size()) return order;
            draw(first_of_ring(by_distance, drawn));
        }
    }

private:
    // All that is not drawn lies in rings or waits for one. From each face, the farthest first, all
    // that lies over it is visited: the last face that no earlier one has reached waits for none
    // but those of its own ring, of which it is the farthest (Kosaraju's order of a graph).
    std::size_t first_of_ring(const std::vector<std::size_t>& by_distance,
                              std::vector<bool> visited) const {
        std::size_t last = 0;
        for (const std::size_t face : by_distance)
            if (!visited[face]) visit_from(last = face, visited);
        return last;
    }
    void visit_from(std::size_t root, std::vector<bool>& visited) const {
        visited[root] = true;
        for (std::vector<std::size_t> open = {root}; !open.empty();) {
            const std::size_t face = open.back();
            open.pop_back();
            for (const std::size_t after : before_[face])
                if (!visited[after]) {
                    visited[after] = true;
                    open.push_back(after);
                }
        }
    }

    std::vector<std::vector<std::size_t>> before_; // each triangle: those that lie over it
    std::vector<std::size_t> waits_;               // for how many
};

} // namespace

void hidden_painters_ordered(const HiddenTask& task, const Shade& shade) {
    std::vector<std::size_t> by_distance(task.triangles.size());
    for (std::size_t i = 0; i < by_distance.size(); ++i)
        by_distance[i] = i;
    std::stable_sort(by_distance.begin(), by_distance.end(), [&](std::size_t a, std::size_t b) {
        return task.triangles[a].distance_of_middle() > task.triangles[b].distance_of_middle();
    });
    for (const std::size_t i : Order(task).sorted(by_distance))
        fill_in_picture(task, task.triangles[i],
                        [&](int y, int x0, int x1) { shade(task.triangles[i], y, x0, x1); });
}

} // namespace scanout::textbook
