#include "geom/join_table.h"

#include <map>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

// Rows are numbers; `spread` decides how many different hashes there are.
struct Numbers {
    std::vector<std::uint32_t>& rows;
    std::span<const std::uint32_t> items;
    std::uint64_t spread;

    std::uint64_t of(std::uint32_t value) const { return mix_bits(mix_bits(value) % spread); }
    std::uint64_t hash(std::size_t item) const { return of(items[item]); }
    std::uint64_t hash_of_row(std::uint32_t row) const { return of(rows[row]); }
    bool same(std::size_t a, std::size_t b) const { return items[a] == items[b]; }
    bool is_row(std::size_t item, std::uint32_t row) const { return rows[row] == items[item]; }
    void make_room(std::size_t count) const { rows.resize(count); }
    void write(std::size_t item, std::uint32_t row) const { rows[row] = items[item]; }
};

// The table may be divided into parts where many rows are expected.
RC_GTEST_PROP(JoinTable, NumbersRowsInTheOrderOfFirstUse, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> values(random() % 3000);
    const std::uint32_t different = random() % 2000 + 1;
    for (std::uint32_t& value : values)
        value = static_cast<std::uint32_t>(random()) % different;
    const std::size_t batch = random() % 999 + 1;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (const std::uint32_t value : values)
        expected.try_emplace(value, static_cast<std::uint32_t>(expected.size()));
    for (const int threads : {1, 3}) {
        Jobs jobs(threads);
        for (const std::uint64_t spread :
             {std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{1} << 40}) {
            JoinTable table(jobs, random() % 2 == 0 ? 0 : 5000);
            std::vector<std::uint32_t> rows;
            for (std::size_t at = 0; at < values.size(); at += batch) {
                const std::size_t count = std::min(batch, values.size() - at);
                const std::span items = std::span(values).subspan(at, count);
                const auto numbers = table.join(count, Numbers{rows, items, spread});
                RC_ASSERT(numbers.size() == count);
                for (std::size_t i = 0; i < count; ++i)
                    RC_ASSERT(numbers[i] == expected.at(items[i]));
            }
            RC_ASSERT(table.rows() == expected.size() && rows.size() == expected.size());
        }
    }
}

TEST(JoinTable, GrowsFromNothingToAMillionRows) {
    std::vector<std::uint32_t> values(1'000'000);
    for (std::uint32_t i = 0; i < values.size(); ++i)
        values[i] = i;
    for (const std::size_t expected : {0, 5000}) { // whole, and in parts
        Jobs jobs(3);
        JoinTable table(jobs, expected);
        std::vector<std::uint32_t> rows;
        for (int round = 0; round < 2; ++round)
            for (std::size_t at = 0; at < values.size(); at += 125'000) {
                const std::span items = std::span(values).subspan(at, 125'000);
                const auto numbers =
                    table.join(items.size(), Numbers{rows, items, std::uint64_t{1} << 60});
                ASSERT_TRUE(std::equal(numbers.begin(), numbers.end(), items.begin()));
            }
        EXPECT_EQ(table.rows(), 1'000'000u);
    }
}

TEST(JoinTable, ABatchOfNothingAddsNothing) {
    Jobs jobs(2);
    JoinTable table(jobs, 5000);
    std::vector<std::uint32_t> rows;
    EXPECT_TRUE(table.join(0, Numbers{rows, {}, 1}).empty());
    EXPECT_EQ(table.rows(), 0u);
}

} // namespace
} // namespace scanout::geom
