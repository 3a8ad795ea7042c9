// A million random interactions, and every way back (HARD-CASES 22-25).
#include "app/view/viewer.h"
#include "support/random.h"
#include "triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using Id = ActionId;
using ::scanout::test::Random;

constexpr int kInteractions = 1'000'000, kUndone = 256; // as many as the viewer remembers

class Hand {
public:
    explicit Hand(std::uint64_t seed) : random_(seed), viewer(Settings(), 640, 480, 3) {}
    // Keys, drags, the wheel, views, projections, axes, and the mode that they act in.
    void act() {
        const int kind = random_.whole(0, 19);
        if (kind < 12) {
            apply(static_cast<Id>(random_.whole(0, static_cast<int>(Id::toggle_info) - 1)), {});
        } else if (kind < 17) {
            constexpr Id kDrags[] = {Id::drag_rotate, Id::drag_move, Id::drag_roll};
            const Id drag = kDrags[random_.whole(0, 2)];
            apply(Id::drag_begin, {});
            for (int i = random_.whole(1, 3); i > 0; --i)
                apply(drag, {random_.whole(-2000, 2000), random_.whole(-2000, 2000), 0});
            apply(Id::drag_end, {});
        } else {
            apply(Id::zoom_at,
                  {random_.whole(-40, 40), random_.whole(-100, 800), random_.whole(-100, 600)});
        }
    }
    void apply(Id id, const std::array<int, 3>& numbers) {
        viewer.apply({id, numbers, {}, false}, &mesh);
    }
    const Look& look() const { return viewer.state().look; }

private:
    Random random_;

public:
    const geom::Mesh mesh = test::triangle_mesh();
    Viewer viewer;
};

// How far the columns of the matrix are from being at right angles and of one length, of that
// length. The model's scale is one number here.
double skew(const DMat3& m) {
    const double size = dot3(m[0], m[0]);
    double worst = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k <= i; ++k)
            worst = std::max(worst, std::abs(dot3(m[i], m[k]) / size - (i == k ? 1 : 0)));
    return worst;
}

bool is_finite(const scene::View& v) {
    double sum = v.near_distance + v.half_width + v.half_height + v.depth_origin + v.depth_scale;
    for (int i = 0; i < 3; ++i)
        sum += v.translation[i] - v.translation[i] + (v.linear[i].x - v.linear[i].x);
    return std::isfinite(sum);
}

struct Before {
    Look look;
    scene::View view;
};

bool same_bits(const scene::View& a, const scene::View& b) {
    return std::memcmp(&a.linear, &b.linear, sizeof a.linear) == 0 &&
           std::memcmp(&a.translation, &b.translation, sizeof a.translation) == 0 &&
           std::memcmp(&a.near_distance, &b.near_distance, sizeof a.near_distance) == 0 &&
           std::memcmp(&a.half_width, &b.half_width, sizeof a.half_width) == 0 &&
           a.projection == b.projection;
}

TEST(Steady, AMillionInteractionsLeaveARotationAndUndoBringsEveryViewBack) {
    Hand hand(1);
    std::deque<Before> before;
    double worst = 0;
    int changes = 0;
    for (int i = 0; i < kInteractions; ++i) {
        const Look look = hand.look();
        const auto view = hand.viewer.view(hand.mesh);
        ASSERT_TRUE(view) << i << ' ' << view.error().what;
        ASSERT_TRUE(is_finite(*view)) << i;
        worst = std::max(worst, skew(view->linear));
        hand.act();
        if (hand.look() == look) continue;
        ++changes;
        before.push_back({look, *view});
        if (before.size() > kUndone) before.pop_front();
    }
    EXPECT_LE(worst, 1e-9);
    EXPECT_GT(changes, kInteractions / 2);
    RecordProperty("worst_skew", testing::PrintToString(worst));
    RecordProperty("changes", changes);
    for (std::size_t i = before.size(); i-- > 0;) {
        hand.apply(Id::undo, {});
        ASSERT_EQ(hand.look(), before[i].look) << i;
        ASSERT_TRUE(same_bits(*hand.viewer.view(hand.mesh), before[i].view)) << i;
    }
    hand.apply(Id::undo, {});
    EXPECT_EQ(hand.viewer.answer(), "nothing to undo");
}

// The same interactions give the same state, on any machine and at any time.
TEST(Steady, TheSameInteractionsEndInTheSameView) {
    Hand one(2), other(2);
    for (int i = 0; i < 100'000; ++i)
        one.act(), other.act();
    EXPECT_EQ(one.look(), other.look());
    EXPECT_TRUE(same_bits(*one.viewer.view(one.mesh), *other.viewer.view(other.mesh)));
}

// From the present scale to the greatest, 2^20 times, and back.
TEST(Steady, OverTheWholeRangeOfScaleAndBackIsTheSameView) {
    Hand hand(3);
    const scene::View start = *hand.viewer.view(hand.mesh);
    std::vector<scene::View> way;
    int steps = 0;
    Look last;
    do {
        last = hand.look();
        way.push_back(*hand.viewer.view(hand.mesh));
        ASSERT_TRUE(is_finite(way.back()));
        ASSERT_LE(skew(way.back().linear), 1e-9);
        hand.apply(Id::scale_up, {});
        ++steps;
    } while (!(hand.look() == last));
    const double grown = std::sqrt(dot3(way.back().linear[0], way.back().linear[0]) /
                                   dot3(start.linear[0], start.linear[0]));
    EXPECT_GT(grown, 1e6); // where the scale ends
    RecordProperty("scale", testing::PrintToString(grown));
    RecordProperty("steps", steps);
    for (std::size_t i = way.size() - 1; i-- > 0;) {
        hand.apply(Id::scale_down, {});
        ASSERT_TRUE(same_bits(*hand.viewer.view(hand.mesh), way[i])) << i;
    }
}

} // namespace
} // namespace scanout::app
