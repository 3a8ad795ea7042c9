// The answer is the least of all limits; each is forged in turn.
#include "base/available_memory.h"
#include "temporary_folder.h"

#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace scanout::test {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

class AvailableMemory : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const {
        const std::filesystem::path path = folder_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    std::uint64_t answer() const { return available_bytes(folder_ / "proc", folder_ / "cgroup"); }

private:
    TemporaryFolder folder_;
};

TEST_F(AvailableMemory, OfAMachineThatTellsNothingIsUnlimited) {
    EXPECT_EQ(answer(), kUnlimited);
}

TEST_F(AvailableMemory, OfTheMachineIsWhatTheKernelCallsAvailable) {
    write("proc/meminfo", "MemTotal:  9000 kB\nMemFree:  1 kB\nMemAvailable:   5000 kB\n");
    EXPECT_EQ(answer(), 5000U * 1024);
}

TEST_F(AvailableMemory, IsWhatTheTightestGroupLeavesWithoutItsPageCache) {
    write("proc/meminfo", "MemAvailable:   5000 kB\n");
    write("proc/self/cgroup", "0::/outer/inner\n");
    write("cgroup/outer/inner/memory.max", "max\n");
    write("cgroup/outer/inner/memory.current", "700\n");
    EXPECT_EQ(answer(), 5000U * 1024) << "max is no limit";
    write("cgroup/outer/memory.max", "1000000\n");
    write("cgroup/outer/memory.current", "700000\n");
    EXPECT_EQ(answer(), 300'000U);
    write("cgroup/outer/memory.stat", "anon 650000\ninactive_file 50000\n");
    EXPECT_EQ(answer(), 350'000U);
    write("cgroup/outer/inner/memory.max", "1000\n");
    EXPECT_EQ(answer(), 300U);
    write("cgroup/outer/inner/memory.current", "2000\n");
    EXPECT_EQ(answer(), 0U) << "a group over its limit leaves nothing";
}

TEST_F(AvailableMemory, KnowsTheFirstVersionOfGroupsToo) {
    write("proc/self/cgroup", "5:cpu,cpuacct:/\n4:hugetlb,memory:/docker/0a1b\n1:name=systemd:/\n");
    write("cgroup/memory/memory.limit_in_bytes",
          "800000\n"); // a container sees its own as the root
    write("cgroup/memory/memory.usage_in_bytes", "300000\n");
    write("cgroup/memory/memory.stat", "inactive_file 5\ntotal_inactive_file 100000\n");
    EXPECT_EQ(answer(), 600'000U);
    write("cgroup/memory/docker/0a1b/memory.limit_in_bytes", "9223372036854771712\n");
    write("cgroup/memory/docker/0a1b/memory.usage_in_bytes", "300000\n");
    EXPECT_EQ(answer(), 600'000U);
    write("cgroup/memory/docker/0a1b/memory.limit_in_bytes", "300001\n");
    EXPECT_EQ(answer(), 1U);
}

TEST_F(AvailableMemory, IsWhatTheLimitOfTheAddressSpaceLeaves) {
    write("proc/self/status", "VmPeak:  3000000 kB\nVmSize:  1000000 kB\n");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
    constexpr rlim_t kLimit = rlim_t{64} << 40; // above what a sanitizer maps
    const rlimit limit{kLimit, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
    const std::uint64_t limited = answer();
    ::setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(limited, kLimit - 1'024'000'000);
}

TEST_F(AvailableMemory, OfThisMachineIsSomethingAndLessThanAPetabyte) {
    EXPECT_GT(available_bytes(), 1'000'000U);
    EXPECT_LT(available_bytes(), std::uint64_t{1} << 50);
}

} // namespace
} // namespace scanout::test
