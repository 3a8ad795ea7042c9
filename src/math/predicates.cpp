#include "math/predicates.h"

#include "math/bits.h"
#include "math/double_double.h"

namespace scanout {
namespace {

int sign_of(double x) {
    return (x > 0) - (x < 0);
}

// A sum of doubles kept exactly, as components that do not overlap, in order of magnitude.
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
    // The greatest component that is not zero outweighs all others.
    int sign() const {
        for (int i = count_ - 1; i >= 0; --i)
            if (components_[i] != 0) return sign_of(components_[i]);
        return 0;
    }

private:
    double components_[12] = {};
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

    Expansion sum; // the determinant without its differences, which round
    sum.add_product(a.x, b.y);
    sum.add_product(-a.y, b.x);
    sum.add_product(b.x, c.y);
    sum.add_product(-b.y, c.x);
    sum.add_product(c.x, a.y);
    sum.add_product(-c.y, a.x);
    return sum.sign();
}

} // namespace scanout
