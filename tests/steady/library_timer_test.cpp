// The vector library's timer is not measured when a program starts (simd/targets.cpp): in this
// program, which names no target, the dynamic linker finds our definition and not the library's.
#include <cstdint>
#include <string_view>

#include <dlfcn.h>
#include <gtest/gtest.h>

TEST(LibraryTimer, IsOursInEveryProgram) {
    void* found = dlsym(RTLD_DEFAULT, "_ZN3hwy8platform15TimerResolutionEv");
    ASSERT_NE(found, nullptr);
    Dl_info info{};
    ASSERT_NE(dladdr(found, &info), 0);
    EXPECT_EQ(std::string_view(info.dli_fname).find("libhwy"), std::string_view::npos)
        << info.dli_fname;
}
