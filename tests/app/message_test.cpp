#include "app/message.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

RC_GTEST_PROP(Escaped, NoByteOfAnyTextReachesTheTerminalAsAControl,
              (const std::vector<std::uint8_t>& bytes)) {
    const std::string out = escaped(std::string(bytes.begin(), bytes.end()));
    RC_ASSERT(std::none_of(out.begin(), out.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    }));
    RC_ASSERT(out.find("\xc2\x9b") == std::string::npos); // CSI as one character
    RC_ASSERT(escaped(out) == out);
}

TEST(Escaped, PrintableTextOfAnyLanguageIsLeftAsItIs) {
    for (const char* text : {"", "a plain name.obj", "h\xc3\xb6he \xe6\xa8\xa1\xe5\x9e\x8b.obj",
                             "\xf0\x9f\x90\xae.png", "\xef\xbf\xbd"})
        EXPECT_EQ(escaped(text), text);
}

TEST(Escaped, ControlsDirectionMarksAndBrokenUtf8AreHexadecimal) {
    EXPECT_EQ(escaped("a\x1b[31mb\n\r\t\x7f"), "a\\x1b[31mb\\x0a\\x0d\\x09\\x7f");
    EXPECT_EQ(escaped("\xc2\x9b"
                      "2J"),
              "\\xc2\\x9b2J");
    EXPECT_EQ(escaped("\xe2\x80\xae"
                      "gnp.a"),
              "\\xe2\\x80\\xaegnp.a");
    EXPECT_EQ(escaped("\xff\xc3(\xed\xa0\x80"), "\\xff\\xc3(\\xed\\xa0\\x80");
    EXPECT_EQ(escaped(std::string_view("a\0b", 3)), "a\\x00b");
}

} // namespace
} // namespace scanout::app
