// log2, exp2 and pow in double-double, so that pow's product y log2 x keeps its bits: all
// constexpr, which lets tables (sRGB) be computed by the compiler. Method: Tang 1989 and Tang 1990,
// with the logarithm's series in (m - c) / (m + c). The tables are held against MPFR by the tests.
#pragma once

#include "math/bits.h"
#include "math/double_double.h"

namespace scanout::detail {

inline constexpr Dd kLog2E = {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56}; // 1 / ln 2
inline constexpr Dd kLn2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

inline constexpr int kLog2First = 23;
// log2(i / 32) for i = 23 .. 45, which spans sqrt(1/2) .. sqrt(2).
inline constexpr Dd kLog2Table[] = {
    {-0x1.e7df5fe538ab3p-2, -0x1.3bed456b24ed1p-56},
    {-0x1.a8ff971810a5ep-2, -0x1.817fd3b7d7e5dp-58},
    {-0x1.6cb0f6865c8eap-2, -0x1.b6d40900b2502p-61},
    {-0x1.32bfee370ee68p-2, -0x1.968925e378d68p-56},
    {-0x1.f5fd8a9063e35p-3, 0x1.bdc0426c3c274p-57},
    {-0x1.8a8980abfbd32p-3, -0x1.99aa6df8b7d83p-57},
    {-0x1.22dadc2ab3497p-3, 0x1.696e2866c718ep-58},
    {-0x1.7d60496cfbb4cp-4, -0x1.9ced1447e30adp-58},
    {-0x1.77394c9d958d5p-5, -0x1.77970e03f821cp-59},
    {0.0, 0.0},
    {0x1.6bad3758efd87p-5, 0x1.89b03784b5be1p-60},
    {0x1.663f6fac91316p-4, 0x1.f3314e0985116p-58},
    {0x1.08c588cda79e4p-3, -0x1.a7610e40bd6abp-57},
    {0x1.5c01a39fbd688p-3, -0x1.817fd3b7d7e5dp-57},
    {0x1.acf5e2db4ec94p-3, -0x1.01ee1343fe7cap-59},
    {0x1.fbc16b902680ap-3, 0x1.1d46ccc53c278p-58},
    {0x1.24407ab0e073ap-2, -0x1.f6e91ad16ecffp-56},
    {0x1.49a784bcd1b8bp-2, -0x1.b6d40900b2502p-62},
    {0x1.6e221cd9d0cdep-2, 0x1.5e35482d13dc1p-56},
    {0x1.91bba891f1709p-2, -0x1.2d352bea51e59p-56},
    {0x1.b47ebf73882a1p-2, -0x1.6fae441c09d76p-56},
    {0x1.d6753e032ea0fp-2, -0x1.c141e66faaaadp-62},
    {0x1.f7a8568cb06cfp-2, -0x1.8f3673ffdd785p-57},
};

// 2^(i / 32) for i = 0 .. 31.
inline constexpr Dd kExp2Table[] = {
    {1.0, 0.0},
    {0x1.059b0d3158574p+0, 0x1.d73e2a475b465p-55},
    {0x1.0b5586cf9890fp+0, 0x1.8a62e4adc610bp-54},
    {0x1.11301d0125b51p+0, -0x1.6c51039449b3ap-54},
    {0x1.172b83c7d517bp+0, -0x1.19041b9d78a76p-55},
    {0x1.1d4873168b9aap+0, 0x1.e016e00a2643cp-54},
    {0x1.2387a6e756238p+0, 0x1.9b07eb6c70573p-54},
    {0x1.29e9df51fdee1p+0, 0x1.612e8afad1255p-55},
    {0x1.306fe0a31b715p+0, 0x1.6f46ad23182e4p-55},
    {0x1.371a7373aa9cbp+0, -0x1.63aeabf42eae2p-54},
    {0x1.3dea64c123422p+0, 0x1.ada0911f09ebcp-55},
    {0x1.44e086061892dp+0, 0x1.89b7a04ef80d0p-59},
    {0x1.4bfdad5362a27p+0, 0x1.d4397afec42e2p-56},
    {0x1.5342b569d4f82p+0, -0x1.07abe1db13cadp-55},
    {0x1.5ab07dd485429p+0, 0x1.6324c054647adp-54},
    {0x1.6247eb03a5585p+0, -0x1.383c17e40b497p-54},
    {0x1.6a09e667f3bcdp+0, -0x1.bdd3413b26456p-54},
    {0x1.71f75e8ec5f74p+0, -0x1.16e4786887a99p-55},
    {0x1.7a11473eb0187p+0, -0x1.41577ee04992fp-55},
    {0x1.82589994cce13p+0, -0x1.d4c1dd41532d8p-54},
    {0x1.8ace5422aa0dbp+0, 0x1.6e9f156864b27p-54},
    {0x1.93737b0cdc5e5p+0, -0x1.75fc781b57ebcp-57},
    {0x1.9c49182a3f090p+0, 0x1.c7c46b071f2bep-56},
    {0x1.a5503b23e255dp+0, -0x1.d2f6edb8d41e1p-54},
    {0x1.ae89f995ad3adp+0, 0x1.7a1cd345dcc81p-54},
    {0x1.b7f76f2fb5e47p+0, -0x1.5584f7e54ac3bp-56},
    {0x1.c199bdd85529cp+0, 0x1.11065895048ddp-55},
    {0x1.cb720dcef9069p+0, 0x1.503cbd1e949dbp-56},
    {0x1.d5818dcfba487p+0, 0x1.2ed02d75b3707p-55},
    {0x1.dfc97337b9b5fp+0, -0x1.1a5cd4f184b5cp-54},
    {0x1.ea4afa2a490dap+0, -0x1.e9c23179c2893p-54},
    {0x1.f50765b6e4540p+0, 0x1.9d3e12dd8a18bp-54},
};

// log2 x for finite x > 0, relative error below 2^-65 (near 1 too).
constexpr Dd log2_dd(double x) {
    auto [m, exponent] = decompose(x);
    if (m > 0x1.6a09e667f3bcdp+0) { // sqrt(2): below it, so that x near 1 has exponent 0
        m *= 0.5;
        ++exponent;
    }
    const int i = static_cast<int>(nearest_integer(m * 32.0));
    const double c = i / 32.0;
    // ln(m / c) = 2 atanh(s) = 2 (s + s^3/3 + s^5/5 + ...), |s| < 0.0112
    const Dd s = Dd{m - c} / two_sum(m, c);
    const double z = s.hi * s.hi;
    const double series = 1.0 / 3 + z * (1.0 / 5 + z * (1.0 / 7 + z * (1.0 / 9)));
    const Dd atanh = quick_two_sum(s.hi, s.lo + s.hi * (z * series));
    const Dd log_of_rest = Dd{2.0 * atanh.hi, 2.0 * atanh.lo} * kLog2E;
    return Dd{static_cast<double>(exponent)} + (kLog2Table[i - kLog2First] + log_of_rest);
}

// 2^(x.hi + x.lo), rounded once where the result is normal; beyond the range 0 or infinity.
constexpr double exp2_dd(Dd x) {
    if (x.hi > 1024.0) return kInfinity; // at 1024 the low part decides
    if (x.hi < -1075.0) return 0.0;
    const int n = static_cast<int>(nearest_integer(x.hi * 32.0));
    // 2^x = 2^exponent 2^(i/32) e^u, |u| < 0.0109; x.hi - n/32 is exact
    const int i = n & 31;
    const int exponent = (n - i) / 32;
    const double rest = x.hi - n / 32.0;
    const double u = rest * kLn2.hi + (rest * kLn2.lo + x.lo * kLn2.hi);
    const double series =
        1.0 / 2 +
        u * (1.0 / 6 + u * (1.0 / 24 + u * (1.0 / 120 + u * (1.0 / 720 + u * (1.0 / 5040)))));
    const double expm1 = u + u * (u * series);
    const Dd t = kExp2Table[i];
    return scale(t.hi + (t.lo + t.hi * expm1), exponent);
}

// base^exponent for finite base > 0 and finite exponent.
constexpr double pow_positive(double base, double exponent) {
    if (base == 1.0) return 1.0;
    const Dd log = log2_dd(base);
    // |log2 base| >= 2^-53 here, so that such an exponent is beyond the range; two_product is not.
    if (magnitude(exponent) > power_of_two(80)) {
        return (log.hi > 0) == (exponent > 0) ? kInfinity : 0.0;
    }
    return exp2_dd(log * Dd{exponent});
}

} // namespace scanout::detail
