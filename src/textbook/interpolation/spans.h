// Values stepped down both edges of a triangle and then along each line [Compendium 3.2.4], which
// saves the areas of the direct methods. The document begins at the vertex, wherever between two
// lines it lies, and its last step ends beyond the edge [Compendium 11.4]; here a step begins at
// the first pixel centre, which is the cure.
#pragma once

#include "textbook/interpolation/interpolation.h"

namespace scanout::textbook {

// What is stepped: a place along the line, the values, and 1/w for those that divide by it.
struct Step {
    double x = 0, one_over_w = 1;
    Values values{};
};

enum class BeginsAt : std::uint8_t { pixel_centre, vertex };

class Spans {
public:
    // divided: the values are divided by w, and one_over_w is 1/w.
    Spans(const Triangle& triangle, bool divided, BeginsAt begins = BeginsAt::pixel_centre);
    // Calls of(x, step) for the pixels of a part of a line.
    template <class Of>
    void line(int y, int x0, int x1, Of of) {
        const auto [at_first, dx] = begin(y, x0);
        Step at = at_first;
        for (int x = x0; x < x1; ++x) {
            of(x, at);
            add(at, dx);
        }
    }

private:
    // An edge from its upper end down; `at` is where it meets the centre of line `row`.
    struct Edge {
        Step at, down;
        int first = 0, last = 0, row = 0;
        Step begin{};
        void go_to(int line);
    };
    Edge edge_between(const Corner& upper, const Corner& lower, const Step& from,
                      const Step& to) const;
    static void add(Step& step, const Step& by);
    std::pair<Step, Step> begin(int y, int x0);

    BeginsAt begins_;
    Edge long_, upper_, lower_;
    double middle_y_ = 0;
};

} // namespace scanout::textbook
