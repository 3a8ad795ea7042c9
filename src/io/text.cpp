#include "io/text.h"

#include <algorithm>
#include <array>

namespace scanout::io {
namespace {

// Length of the valid UTF-8 character at the start of `text` that may be printed; 0: none.
std::size_t printable_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) >= 0x20 && byte(0) < 0x7f) return 1;
    const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
    if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    if (byte(0) == 0xc2 && byte(1) < 0xa0) return 0;  // C1 controls
    if (byte(0) == 0xe0 && byte(1) < 0xa0) return 0;  // overlong
    if (byte(0) == 0xed && byte(1) >= 0xa0) return 0; // surrogates
    if (byte(0) == 0xf0 && byte(1) < 0x90) return 0;  // overlong
    if (byte(0) == 0xf4 && byte(1) >= 0x90) return 0; // above U+10FFFF
    if (byte(0) == 0xe2 && byte(1) == 0x80 && byte(2) >= 0xa8)
        return 0; // line ends, direction marks
    return length;
}

struct Magic {
    std::string_view bytes, meaning;
};

constexpr std::array kMagic = {
    Magic{"\x1f\x8b", "is compressed with gzip: unpack it first (gunzip)"},
    Magic{"\xfd"
          "7zXZ",
          "is compressed with xz: unpack it first (unxz)"},
    Magic{"BZh", "is compressed with bzip2: unpack it first (bunzip2)"},
    Magic{"\x28\xb5\x2f\xfd", "is compressed with zstd: unpack it first (unzstd)"},
    Magic{"PK\x03\x04", "is a ZIP archive: unpack it first (unzip)"},
    Magic{"7z\xbc\xaf\x27\x1c", "is a 7-Zip archive: unpack it first"},
    Magic{"\x89PNG", "is a PNG picture, not a model"},
    Magic{"\xff\xd8\xff", "is a JPEG picture, not a model"},
    Magic{"GIF8", "is a GIF picture, not a model"},
    Magic{"%PDF", "is a PDF document, not a model"},
    Magic{"\x7f"
          "ELF",
          "is a program, not a model"},
    Magic{"glTF", "is a binary glTF file: give it the extension .glb"},
    Magic{"ply\n", "is a PLY file: give it the extension .ply"},
    Magic{"ply\r", "is a PLY file: give it the extension .ply"},
    Magic{"version https://git-lfs",
          "is a Git LFS pointer, the model itself is missing: fetch it (git lfs pull)"},
    Magic{"\xff\xfe", "is UTF-16 text: save it as UTF-8 (iconv -f UTF-16 -t UTF-8)"},
    Magic{"\xfe\xff", "is UTF-16 text: save it as UTF-8 (iconv -f UTF-16 -t UTF-8)"},
};

bool is_utf16_without_mark(std::string_view head) {
    std::size_t even = 0, odd = 0;
    for (std::size_t i = 0; i + 1 < head.size(); i += 2) {
        even += head[i] == '\0';
        odd += head[i + 1] == '\0';
    }
    const std::size_t pairs = head.size() / 2;
    return pairs >= 8 && std::max(even, odd) * 10 > pairs * 8 && std::min(even, odd) * 10 < pairs;
}

} // namespace

std::string shown(std::string_view text, std::size_t limit) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = printable_length(text);
        if (out.size() + std::max<std::size_t>(length, 1) > limit) return out + "...";
        out += length == 0 ? std::string_view("?") : text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::optional<std::string> not_a_text_model(std::string_view file) {
    for (const Magic& magic : kMagic)
        if (file.starts_with(magic.bytes)) return std::string(magic.meaning);
    const std::string_view head = file.substr(0, 4096);
    if (!head.empty() && head.find_first_not_of('\0') == std::string_view::npos)
        return "holds zero bytes instead of text: the download or copy was cut short";
    if (is_utf16_without_mark(head))
        return "is UTF-16 text: save it as UTF-8 (iconv -f UTF-16 -t UTF-8)";
    const std::string start = lower_case(head.substr(0, 512));
    const std::size_t first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first != std::string::npos)
        for (const std::string_view mark : {"<!doctype html", "<html", "<head", "<body"})
            if (std::string_view(start).substr(first).starts_with(mark))
                return "is a web page (HTML), not a model: download the file itself";
    if (first != std::string::npos && std::string_view(start).substr(first).starts_with("<?xml"))
        return "is an XML document, not a model";
    return std::nullopt;
}

} // namespace scanout::io
