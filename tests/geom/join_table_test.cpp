#include "geom/join_table.h"

#include <map>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

// Rows are numbers; `spread` decides how many different hashes there are.
RC_GTEST_PROP(JoinTable, NumbersRowsInTheOrderOfFirstUse, (std::vector<std::uint16_t> values)) {
    for (const std::uint64_t spread :
         {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{1} << 40}) {
        JoinTable table(values.size() % 3);
        std::vector<std::uint16_t> rows;
        std::map<std::uint16_t, std::uint32_t> expected;
        const auto hash = [&](std::uint16_t value) { return mix_bits(value) % spread; };
        for (const std::uint16_t value : values) {
            expected.try_emplace(value, static_cast<std::uint32_t>(expected.size()));
            const std::uint32_t row = table.find_or_add(
                hash(value), [&](std::uint32_t i) { return rows[i] == value; },
                [&] { rows.push_back(value); }, [&](std::uint32_t i) { return hash(rows[i]); });
            RC_ASSERT(row == expected.at(value));
        }
        RC_ASSERT(table.rows() == expected.size() && rows.size() == expected.size());
    }
}

TEST(JoinTable, GrowsFromNothingToAMillionRows) {
    JoinTable table(0);
    std::vector<std::uint32_t> rows;
    for (int round = 0; round < 2; ++round)
        for (std::uint32_t value = 0; value < 1'000'000; ++value)
            ASSERT_EQ(table.find_or_add(
                          mix_bits(value), [&](std::uint32_t i) { return rows[i] == value; },
                          [&] { rows.push_back(value); },
                          [&](std::uint32_t i) { return mix_bits(rows[i]); }),
                      value);
    EXPECT_EQ(table.rows(), 1'000'000u);
}

} // namespace
} // namespace scanout::geom
