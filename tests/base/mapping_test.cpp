// A file that changes while it is read, is larger than memory, or mostly holes.
#include "base/mapping.h"
#include "base/memory.h"
#include "base/write_file.h"
#include "temporary_folder.h"

#include <atomic>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::test {
namespace {

using ::testing::HasSubstr;

std::uint64_t sum_of(std::string_view text) {
    std::uint64_t sum = 0;
    for (const char c : text)
        sum += static_cast<unsigned char>(c);
    return sum;
}

TEST(Mapping, OfAFileThatIsCutShortAfterwardsKeepsItsBytes) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "a", std::string(1'000'000, '\1')));
    const Result<Mapping> mapping = Mapping::open(folder / "a");
    ASSERT_TRUE(mapping);
    std::filesystem::resize_file(folder / "a", 0);
    EXPECT_EQ(sum_of(mapping->text()), 1'000'000U);
}

// Another thread cuts the file short and writes it anew without a pause. What is opened is one of
// the two files, or is refused (that it can be is the next test's matter: here it is up to the
// scheduler); it never ends the program, and no byte of it is from nowhere.
TEST(Mapping, OfAFileThatIsCutShortWhileItIsReadIsWholeOrRefused) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    constexpr std::size_t kSize = 3'000'000;
    ASSERT_TRUE(write_file(path, std::string(kSize, '\1')));
    std::atomic<bool> stop = false;
    std::thread changing([&] {
        for (std::uintmax_t size = 0; !stop; size = (size + 1'234'567) % kSize) {
            std::filesystem::resize_file(path, size);
            std::filesystem::resize_file(path, kSize);
        }
    });
    for (int i = 0; i < 300; ++i) {
        const Result<Mapping> mapping = Mapping::open(path);
        if (mapping) {
            EXPECT_LE(sum_of(mapping->text()), mapping->size());
            continue;
        }
        EXPECT_EQ(mapping.error().what, path + ": changed while it was read; load it again");
        EXPECT_EQ(mapping.error().exit, Exit::unreadable);
    }
    stop = true;
    changing.join();
}

TEST(Mapping, OfAFileThatIsCutShortBetweenItsFirstBytesAndTheRestIsRefused) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    for (const std::uintmax_t left : {0, 1, 5000, 99'999}) {
        ASSERT_TRUE(write_file(path, std::string(100'000, 'x')));
        const Result<Mapping> mapping = Mapping::open(path, [&](auto, auto) -> Result<> {
            std::filesystem::resize_file(path, left);
            return {};
        });
        ASSERT_FALSE(mapping) << left;
        EXPECT_EQ(mapping.error().what, path + ": changed while it was read; load it again");
    }
}

TEST(Mapping, AsksWithTheFirstBytesAndTheSizeBeforeItReads) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    ASSERT_TRUE(write_file(path, std::string_view("head")));
    std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
    const Result<Mapping> mapping =
        Mapping::open(path, [&](std::string_view head, std::uint64_t size) -> Result<> {
            EXPECT_EQ(head.size(), 4096U);
            EXPECT_TRUE(head.starts_with("head"));
            EXPECT_EQ(size, std::uint64_t{1} << 40);
            return fail(Exit::unreadable, "not this one");
        });
    ASSERT_FALSE(mapping);
    EXPECT_EQ(mapping.error().what, "not this one");
}

TEST(Mapping, HolesOfAFileAreZerosThatTakeNoMemory) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    ASSERT_TRUE(write_file(path, std::string_view("start")));
    std::filesystem::resize_file(path, std::uintmax_t{1} << 30);
    const std::uint64_t before = resident_bytes();
    const Result<Mapping> mapping = Mapping::open(path);
    ASSERT_TRUE(mapping) << mapping.error().what;
    EXPECT_EQ(mapping->size(), std::size_t{1} << 30);
    EXPECT_TRUE(mapping->text().starts_with("start"));
    EXPECT_EQ(sum_of(mapping->text().substr((std::size_t{1} << 30) - 1000)), 0U);
    EXPECT_LT(resident_bytes(), before + 8'000'000);
}

TEST(Mapping, GivesBackTheMemoryOfWhatIsDropped) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "a", std::string(64 << 20, 'x')));
    Result<Mapping> mapping = Mapping::open(folder / "a");
    ASSERT_TRUE(mapping);
    const std::uint64_t before = resident_bytes();
    mapping->drop_before((48 << 20) + 5);
    EXPECT_LT(resident_bytes() + (40 << 20), before);
    EXPECT_EQ(mapping->text()[(48 << 20) + 5], 'x');
    EXPECT_EQ(mapping->text().back(), 'x');
}

} // namespace
} // namespace scanout::test
