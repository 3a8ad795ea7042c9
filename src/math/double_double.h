// Double-double arithmetic: an unevaluated sum hi + lo with |lo| <= ulp(hi) / 2, about 106 bits.
// Dekker 1971; Shewchuk 1997. Without fused multiply-add: it must give the same bits where the
// machine has none. Exact while nothing overflows (|x| < 2^995) or underflows.
#pragma once

namespace scanout {

struct Dd {
    double hi = 0;
    double lo = 0;
};

// a + b exactly; |a| >= |b| or a == 0.
constexpr Dd quick_two_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

// a + b exactly.
constexpr Dd two_sum(double a, double b) {
    const double s = a + b;
    const double b_part = s - a;
    const double a_part = s - b_part;
    return {s, (a - a_part) + (b - b_part)};
}

// Halves of 26 bits each, whose products are exact (Veltkamp).
constexpr Dd split(double a) {
    const double c = 134217729.0 * a; // 2^27 + 1
    const double high = c - (c - a);
    return {high, a - high};
}

// a b exactly.
constexpr Dd two_product(double a, double b) {
    const double p = a * b;
    const Dd x = split(a);
    const Dd y = split(b);
    return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

constexpr Dd operator-(Dd a) {
    return {-a.hi, -a.lo};
}

// Relative error of + below 2^-104 unless a and b cancel; the absolute one is 2^-105 (|a| + |b|).
constexpr Dd operator+(Dd a, Dd b) {
    const Dd s = two_sum(a.hi, b.hi);
    return quick_two_sum(s.hi, s.lo + (a.lo + b.lo));
}

constexpr Dd operator-(Dd a, Dd b) {
    return a + -b;
}

constexpr Dd operator*(Dd a, Dd b) {
    const Dd p = two_product(a.hi, b.hi);
    return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr Dd operator/(Dd a, Dd b) {
    const double q = a.hi / b.hi;
    const Dd p = two_product(q, b.hi);
    const double rest = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
    return quick_two_sum(q, rest / b.hi);
}

} // namespace scanout
