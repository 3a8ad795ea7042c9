#include "base/check.h"
#include "base/result.h"

#include <memory>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

Result<std::unique_ptr<int>> positive(int value) {
    if (value <= 0) return fail(Exit::unreadable, "{}:{}: {} is not positive", "a.obj", 12, value);
    return std::make_unique<int>(value);
}

Result<void> check_positive(int value) {
    TRY_VOID(positive(value));
    return {};
}

Result<int> sum(int a, int b, int& reached) {
    TRY(const std::unique_ptr<int> first, positive(a));
    ++reached;
    TRY(const auto second, positive(b));
    ++reached;
    return *first + *second;
}

TEST(Result, CarriesAValueThatCanOnlyBeMoved) {
    int reached = 0;
    const Result<int> result = sum(2, 3, reached);
    ASSERT_TRUE(result);
    EXPECT_EQ(*result, 5);
    EXPECT_EQ(reached, 2);
}

TEST(Result, TryReturnsTheFirstErrorUnchangedAndRunsNothingAfterIt) {
    int reached = 0;
    const Result<int> result = sum(2, -3, reached);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().what, "a.obj:12: -3 is not positive");
    EXPECT_EQ(result.error().exit, Exit::unreadable);
    EXPECT_EQ(reached, 1);
    EXPECT_FALSE(check_positive(-1));
    EXPECT_EQ(check_positive(0).error().what, "a.obj:12: 0 is not positive");
    EXPECT_TRUE(check_positive(1));
}

TEST(CheckDeathTest, NamesThePlaceTheConditionAndTheValues) {
    ::testing::FLAGS_gtest_death_test_style = "threadsafe";
    const int faces = 3;
    CHECK(faces == 3);
    CHECK_EQ(faces, 3);
    EXPECT_DEATH(CHECK(faces == 4),
                 "internal error: .*result_test.cpp:[0-9]+: faces == 4 is false");
    EXPECT_DEATH(CHECK_LT(faces, 2), "faces < 2 is false with 3 and 2");
}

} // namespace
} // namespace scanout::test
