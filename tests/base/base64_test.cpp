// RFC 4648.
#include "base/base64.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Base64, IsThatOfItsStandard) { // section 10
    for (const auto& [bytes, text] : {std::pair{"", ""},
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foob", "Zm9vYg=="},
                                      {"fooba", "Zm9vYmE="},
                                      {"foobar", "Zm9vYmFy"},
                                      {"\xff\xfe\xfd", "//79"}}) {
        EXPECT_EQ(base64(std::string_view(bytes)), text);
        const std::string_view expected = bytes;
        EXPECT_EQ(from_base64(text), Bytes(expected.begin(), expected.end())) << text;
    }
}

RC_GTEST_PROP(Base64, AllBytesComeBack, (const Bytes& bytes)) {
    RC_ASSERT(from_base64(base64(bytes)) == bytes);
}

TEST(Base64, OtherLettersAreRefused) {
    for (const char* const text : {"A", "AAAAA", "A*==", "AA A", "AA=A", "AA-_"})
        EXPECT_EQ(from_base64(text), std::nullopt) << text;
    EXPECT_EQ(from_base64("Zg"), Bytes{'f'}) << "without padding";
}

} // namespace
} // namespace scanout
