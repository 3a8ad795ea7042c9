#include "math/predicates.h"

#include "math/bits.h"
#include "math/double_double.h"

namespace scanout {
namespace {

int sign_of(double x) {
    return (x > 0) - (x < 0);
}

// A sum of at most kCapacity doubles kept exactly, as components that do not overlap, in order of
// magnitude.
template <int kCapacity>
class Expansion {
public:
    // Shewchuk's Grow-Expansion.
    void add(double value) {
        for (int i = 0; i < count_; ++i) {
            const Dd sum = two_sum(value, components_[i]);
            value = sum.hi;
            components_[i] = sum.lo;
        }
        components_[count_++] = value;
    }
    void add_product(double a, double b) {
        const Dd product = two_product(a, b);
        add(product.lo);
        add(product.hi);
    }
    void add_product(double a, double b, double c) {
        const Dd product = two_product(a, b);
        add_product(product.lo, c);
        add_product(product.hi, c);
    }
    // The greatest component that is not zero outweighs all others.
    int sign() const {
        for (int i = count_ - 1; i >= 0; --i)
            if (components_[i] != 0) return sign_of(components_[i]);
        return 0;
    }

private:
    double components_[kCapacity] = {};
    int count_ = 0;
};

} // namespace

int orient2d(const DVec2& a, const DVec2& b, const DVec2& c) {
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double det = left - right;
    constexpr double kHalfUlp = 0x1p-53;
    constexpr double kBound = (3.0 + 16.0 * kHalfUlp) * kHalfUlp; // Shewchuk's ccwerrboundA
    if (magnitude(det) > kBound * (magnitude(left) + magnitude(right))) return sign_of(det);

    Expansion<12> sum; // the determinant without its differences, which round
    sum.add_product(a.x, b.y);
    sum.add_product(-a.y, b.x);
    sum.add_product(b.x, c.y);
    sum.add_product(-b.y, c.x);
    sum.add_product(c.x, a.y);
    sum.add_product(-c.y, a.x);
    return sum.sign();
}

int orient3d(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d) {
    const DVec3 u = a - d, v = b - d, w = c - d;
    const double vw = v.x * w.y, wv = w.x * v.y;
    const double wu = w.x * u.y, uw = u.x * w.y;
    const double uv = u.x * v.y, vu = v.x * u.y;
    const double det = u.z * (vw - wv) + v.z * (wu - uw) + w.z * (uv - vu);
    const double permanent = (magnitude(vw) + magnitude(wv)) * magnitude(u.z) +
                             (magnitude(wu) + magnitude(uw)) * magnitude(v.z) +
                             (magnitude(uv) + magnitude(vu)) * magnitude(w.z);
    constexpr double kHalfUlp = 0x1p-53;
    constexpr double kBound = (7.0 + 56.0 * kHalfUlp) * kHalfUlp; // Shewchuk's o3derrboundA
    if (magnitude(det) > kBound * permanent) return sign_of(det);
    if (permanent == 0) return 0; // in a plane along the axes

    // The determinant without its differences: four of three columns, each of six products.
    Expansion<96> sum;
    const auto add_minor = [&](const DVec3& p, const DVec3& q, const DVec3& r) {
        sum.add_product(p.x, q.y, r.z);
        sum.add_product(-p.x, q.z, r.y);
        sum.add_product(p.y, q.z, r.x);
        sum.add_product(-p.y, q.x, r.z);
        sum.add_product(p.z, q.x, r.y);
        sum.add_product(-p.z, q.y, r.x);
    };
    add_minor(a, b, c);
    add_minor(b, a, d); // minus (a, b, d)
    add_minor(a, c, d);
    add_minor(c, b, d); // minus (b, c, d)
    return sum.sign();
}

int side_of_plane(const DVec3& normal, double offset, const DVec3& p) {
    const double x = normal.x * p.x, y = normal.y * p.y, z = normal.z * p.z;
    const double height = ((x + y) + z) - offset;
    constexpr double kBound = 0x1p-50; // six roundings of 2^-53 each
    if (magnitude(height) >
        kBound * (magnitude(x) + magnitude(y) + magnitude(z) + magnitude(offset)))
        return sign_of(height);

    Expansion<8> sum;
    sum.add_product(normal.x, p.x);
    sum.add_product(normal.y, p.y);
    sum.add_product(normal.z, p.z);
    sum.add(-offset);
    return sum.sign();
}

} // namespace scanout
