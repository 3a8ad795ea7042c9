#include "base/float_environment.h"
#include "base/jobs.h"

#include <atomic>
#include <cfenv>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// At run time, so that the compiler cannot know: denormals are kept, and 1/3 rounds to nearest.
bool arithmetic_is_plain() {
    const volatile float tiny = 1e-40F, one = 1, three = 3;
    const volatile float kept = tiny * one;
    const volatile float third = one / three;
    return kept == 1e-40F && third == 1.0F / 3.0F;
}

TEST(FloatEnvironment, IsPlainWhileItLivesAndComesBack) {
    ASSERT_TRUE(arithmetic_is_plain());
    ASSERT_EQ(std::fesetround(FE_DOWNWARD), 0);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040); // flush to zero, denormals are zero
#endif
    EXPECT_FALSE(arithmetic_is_plain());
    bool inside = false;
    {
        const FloatEnvironment plain;
        inside = arithmetic_is_plain();
    }
    const bool after = arithmetic_is_plain();
    std::atomic<int> plain_jobs = 0;
    for (const int threads : {1, 3}) {
        Jobs jobs(threads);
        jobs.for_each(50, [&](int, int) { plain_jobs += arithmetic_is_plain() ? 1 : 0; });
    }
    const bool after_jobs = arithmetic_is_plain();
    std::fesetenv(FE_DFL_ENV);
    EXPECT_TRUE(inside);
    EXPECT_FALSE(after);
    EXPECT_EQ(plain_jobs, 100);
    EXPECT_FALSE(after_jobs);
}

} // namespace
} // namespace scanout::test
