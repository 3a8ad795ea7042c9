// Interpolation of triangles with a vertex off the screen: beyond the guard band, or behind the
// near plane. Their planes are those of what is drawn: a vertex on the screen stands where it
// snapped to, any other and every cut stays where it is. HARD-CASES P11.
#include "ruler.h"

namespace scanout::test {
namespace {

using oracle::Three;
using oracle::Twofold;

constexpr int kClippedSide = 64;
constexpr double kGuard = 32767; // pixels
constexpr double kNear = 1;

// Pixels times w, w, and u.
struct Point {
    Twofold x, y, w, u;
};
Twofold dot(const Point& p, const Point& q, const Point& r) {
    return p.x * (q.y * r.w - q.w * r.y) + p.y * (q.w * r.x - q.x * r.w) +
           p.w * (q.x * r.y - q.y * r.x);
}

Point in_front_of_the_eye(const Vec3& place, double u) {
    const Twofold half = kClippedSide / 2.0, w = -double{place.z};
    return {(w + Twofold(place.x)) * half, (w - Twofold(place.y)) * half, w, u};
}

bool beyond_near(const Point& p) {
    return p.w.nearest() < kNear;
}
bool off_screen(const Point& p) {
    const double w = p.w.nearest();
    return w < kNear || std::abs(p.x.nearest()) > kGuard * w ||
           std::abs(p.y.nearest()) > kGuard * w;
}
Point snapped(const Point& p) {
    if (off_screen(p)) return p;
    const auto snap = [&](const Twofold& v) {
        return Twofold(std::nearbyint((v / p.w).nearest() * 256) / 256) * p.w;
    };
    return {snap(p.x), snap(p.y), p.w, p.u};
}
Point cut(const Point& in, const Point& out) {
    const Twofold t = (in.w - Twofold(kNear)) / (in.w - out.w);
    const auto at = [&](const Twofold& a, const Twofold& b) { return a + t * (b - a); };
    return {at(in.x, out.x), at(in.y, out.y), kNear, at(in.u, out.u)};
}

// What lies before the near plane, as it is drawn.
std::vector<Point> drawn(const std::array<Point, 3>& t) {
    std::vector<Point> out;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point &a = t[i], &b = t[(i + 1) % 3];
        if (!beyond_near(a)) out.push_back(snapped(a));
        if (beyond_near(a) != beyond_near(b)) out.push_back(beyond_near(a) ? cut(b, a) : cut(a, b));
    }
    return out;
}

class Clipped {
public:
    Clipped() { ruler_.set_near(kNear); }
    // Draws one triangle and looks at all its pixels.
    void look(const std::array<Vec3, 3>& place, const Three& u) {
        ruler_.clear();
        ruler_.add(place, u);
        ruler_.draw();
        std::array<Point, 3> t;
        for (std::size_t i = 0; i < 3; ++i)
            t[i] = in_front_of_the_eye(place[i], u[i]);
        const auto polygon = drawn(t);
        bool seen = false;
        for (int y = 0; y < kClippedSide; ++y)
            for (int x = 0; x < kClippedSide; ++x) {
                if (!ruler_.covered(x, y)) continue;
                const double off = error(polygon, x, y);
                worst = std::max(worst, off);
                seen = true;
                ++samples;
            }
        triangles += seen ? 1 : 0;
    }
    double worst = 0; // 2^-24
    int triangles = 0;
    std::int64_t samples = 0;

private:
    // Snapping may bend the two triangles of a cut polygon; either diagonal will do.
    double error(const std::vector<Point>& p, int x, int y) const {
        double least = HUGE_VAL;
        const std::size_t n = p.size();
        for (std::size_t first = 0; first < (n == 4 ? 4 : 1); ++first) {
            const Point &a = p[first % n], &b = p[(first + 1) % n], &c = p[(first + 2) % n];
            const Point at{x + 0.5, y + 0.5, 1, 0};
            const Twofold e[3] = {dot(at, b, c), dot(a, at, c), dot(a, b, at)};
            const Twofold sum = e[0] + e[1] + e[2];
            const double lowest =
                std::min({(e[0] / sum).nearest(), (e[1] / sum).nearest(), (e[2] / sum).nearest()});
            if (!(lowest >= -0x1p-30)) continue;
            const Twofold u = (e[0] * a.u + e[1] * b.u + e[2] * c.u) / sum;
            least = std::min(least, ruler_.error(x, y, u.nearest()));
        }
        return least;
    }
    Ruler ruler_{kClippedSide};
};

struct Kind {
    const char* name;
    int beyond_guard, behind; // vertices
    bool strip;               // less than 0.02 pixels wide
    double ratio;             // of distances
    friend void PrintTo(const Kind& k, std::ostream* out) { *out << k.name; }
};

struct Pixels {
    double x, y;
    Pixels to(const Pixels& other, double share) const {
        return {x + (other.x - x) * share, y + (other.y - y) * share};
    }
};
// The nearest floats; w may be negative.
Vec3 at(const Pixels& p, double w) {
    const double half = kClippedSide / 2.0;
    return {static_cast<float>((p.x - half) / half * w),
            static_cast<float>((half - p.y) / half * w), static_cast<float>(-w)};
}
double snap(double pixels) {
    return std::nearbyint(pixels * 256) / 256;
}

class Maker {
public:
    Maker(const Kind& kind, Random& random) : kind_(kind), random_(random) {}
    std::array<Vec3, 3> any() {
        std::array<Vec3, 3> v;
        int left = 3 - kind_.beyond_guard - kind_.behind;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto of = static_cast<int>(i);
            if (of < kind_.behind)
                v[i] = at({random_.in(-100, 164), random_.in(-100, 164)}, -distance());
            else if (left-- > 0)
                v[i] = at(inside(), distance());
            else
                v[i] = at(far(static_cast<double>(i)), distance());
        }
        return v;
    }
    // Through a sample; every vertex on the screen is on the grid once it is snapped.
    std::array<Vec3, 3> strip() {
        const Pixels sample{random_.whole(0, kClippedSide - 1) + 0.5,
                            random_.whole(0, kClippedSide - 1) + 0.5};
        const Pixels start = inside();
        const Pixels snapped{snap(start.x), snap(start.y)};
        const double length = std::hypot(sample.x - start.x, sample.y - start.y);
        const double aside = random_.in(0.001, 0.009) / length;
        const double dx = (sample.x - start.x) * aside, dy = (sample.y - start.y) * aside;
        std::array<Vec3, 3> v;
        const double w = distance() * 2;
        const int off = kind_.beyond_guard + kind_.behind;
        v[0] = at(start, w);
        if (off == 1) // another one beside it
            v[1] =
                at({snapped.x + random_.in(-0.006, 0.006), snapped.y + random_.in(-0.006, 0.006)},
                   distance() * 2);
        for (int i = 3 - off; i < 3; ++i) {
            const double side = off == 1 ? 0 : (i == 1 ? 1 : -1);
            const Pixels through{sample.x - side * dy, sample.y + side * dx};
            const bool behind = 3 - i <= kind_.behind;
            const double own = behind ? -distance() : distance();
            const double share = (w - kNear) / (w - own); // of the way to it, where it is cut
            const double reach =
                behind ? random_.in(1.2, 4) * kNear / (share * own) : random_.in(4e4, 4e5) / length;
            v[static_cast<std::size_t>(i)] = at(snapped.to(through, reach), own);
        }
        return v;
    }

private:
    double distance() { return kNear * 1.01 * std::exp2(random_.unit() * std::log2(kind_.ratio)); }
    Pixels inside() {
        return {random_.in(-10, kClippedSide + 10), random_.in(-10, kClippedSide + 10)};
    }
    Pixels far(double third) {
        const double angle = (third + random_.in(-0.45, 0.45)) * 2.0943951;
        const double reach = std::exp2(random_.in(15.6, 20));
        return {reach * std::cos(angle), reach * std::sin(angle)};
    }
    const Kind& kind_;
    Random& random_;
};

constexpr Kind kKinds[] = {
    {"one", 1, 0, false, 10},
    {"one_1e3", 1, 0, false, 1e3},
    {"one_1e6", 1, 0, false, 1e6},
    {"two", 2, 0, false, 10},
    {"two_1e6", 2, 0, false, 1e6},
    {"three", 3, 0, false, 10},
    {"three_1e6", 3, 0, false, 1e6},
    {"one_behind", 0, 1, false, 10},
    {"behind_1e3", 0, 1, false, 1e3},
    {"behind_1e6", 0, 1, false, 1e6},
    {"two_behind", 0, 2, false, 10},
    {"behind_and_beyond", 1, 1, false, 10},
    {"strip_of_one", 1, 0, true, 10},
    {"strip_of_two", 2, 0, true, 10},
    {"strip_of_two_1e3", 2, 0, true, 1e3},
    {"strip_one_behind", 0, 1, true, 10},
    {"strip_two_behind", 0, 2, true, 10},
    {"strip_behind_and_beyond", 1, 1, true, 10},
};
class OffScreen : public testing::TestWithParam<Kind> {};

TEST_P(OffScreen, InterpolationIsWithinTwoToTheMinus20OfTheRange) {
    const Kind& kind = GetParam();
    Random random(17);
    Clipped clipped;
    Maker make(kind, random);
    for (int i = 0; i < 600; ++i) {
        auto place = kind.strip ? make.strip() : make.any();
        std::rotate(place.begin(), place.begin() + i % 3, place.end());
        if (i % 2 == 0) std::swap(place[0], place[1]);
        clipped.look(place, {0, 1 - 0x1p-20, random.whole(0, (1 << 20) - 1) * 0x1p-20});
    }
    EXPECT_LE(clipped.worst, 16); // 2^-20
    EXPECT_GT(clipped.triangles, kind.strip ? 100 : 300);
    record("worst_in_2^-24_of_range", clipped.worst);
    record("triangles_seen", clipped.triangles);
    record("samples", static_cast<double>(clipped.samples));
}

TEST_P(OffScreen, AConstantStaysThatConstantAndTheOrderOfVerticesChangesNoBit) {
    Random random(18);
    Ruler ruler(kClippedSide);
    ruler.set_near(kNear);
    Maker make(GetParam(), random);
    int seen = 0, differ = 0, off = 0;
    for (int i = 0; i < 100; ++i) {
        const auto place = GetParam().strip ? make.strip() : make.any();
        const double constant = random.whole(0, (1 << 24) - 1) * 0x1p-24;
        const Three u = i % 2 == 0 ? Three{constant, constant, constant} : Three{0.75, 0, 0.25};
        image::Image first;
        std::array<std::size_t, 3> order = {0, 1, 2};
        do {
            ruler.clear();
            ruler.add({place[order[0]], place[order[1]], place[order[2]]},
                      {u[order[0]], u[order[1]], u[order[2]]});
            const image::Image& picture = ruler.draw();
            if (first.width() == 0) first = picture;
            for (int y = 0; y < kClippedSide; ++y)
                for (int x = 0; x < kClippedSide; ++x) {
                    differ += picture.at(x, y) == first.at(x, y) ? 0 : 1;
                    if (!ruler.covered(x, y)) continue;
                    ++seen;
                    off += i % 2 == 0 && ruler.error(x, y, constant) != 0 ? 1 : 0;
                }
        } while (std::next_permutation(order.begin(), order.end()));
    }
    EXPECT_EQ(differ, 0);
    EXPECT_EQ(off, 0);
    EXPECT_GT(seen, 200);
}

INSTANTIATE_TEST_SUITE_P(P11, OffScreen, testing::ValuesIn(kKinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

} // namespace
} // namespace scanout::test
