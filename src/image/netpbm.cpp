// PPM (P6) and PAM (P7) with 8 bits a sample: netpbm.sourceforge.net/doc/ppm.html and pam.html.
#include "image/decoders.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace scanout::image {

static Bytes with_header(const std::string& header, std::size_t capacity) {
    Bytes out;
    out.reserve(header.size() + capacity);
    out.assign(header.begin(), header.end());
    return out;
}

Bytes encode_ppm(const Image& image) {
    Bytes out = with_header(fmt::format("P6\n{} {}\n255\n", image.width(), image.height()),
                            image.pixels().size() * 3);
    for (const Rgba8& p : image.pixels())
        out.insert(out.end(), {p.r, p.g, p.b});
    return out;
}

Bytes encode_pam(const Image& image) {
    Bytes out = with_header(
        fmt::format("P7\nWIDTH {}\nHEIGHT {}\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n",
                    image.width(), image.height()),
        image.pixels().size_bytes());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(image.pixels().data());
    out.insert(out.end(), bytes, bytes + image.pixels().size_bytes());
    return out;
}

namespace {

struct Header {
    std::int64_t width = 0, height = 0, depth = 0, max_value = 0;
};

// Words of a text header with # comments up to the end of a line.
class Words {
public:
    explicit Words(std::string_view text) : text_(text) {}

    std::string_view next() {
        while (at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '#')) {
            if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size() - 1);
            ++at_;
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_space(text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    // -1 if the next word is not a whole number.
    std::int64_t number() {
        const std::string_view word = next();
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error == std::errc() && end == word.data() + word.size() ? value : -1;
    }
    std::string_view line() {
        const std::size_t begin = at_;
        at_ = std::min(text_.find('\n', at_), text_.size());
        return text_.substr(begin, at_ - begin);
    }
    // The samples begin after exactly one white-space character behind the header's last word.
    std::size_t samples() const { return std::min(at_ + 1, text_.size()); }

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    std::string_view text_;
    std::size_t at_ = 2; // behind P6 or P7
};

Result<Header> read_pam_header(const Source& file, Words& words) {
    Header header;
    for (;;) {
        const std::string_view word = words.next();
        if (word == "ENDHDR") return header;
        if (word == "WIDTH")
            header.width = words.number();
        else if (word == "HEIGHT")
            header.height = words.number();
        else if (word == "DEPTH")
            header.depth = words.number();
        else if (word == "MAXVAL")
            header.max_value = words.number();
        else if (word == "TUPLTYPE")
            words.line(); // DEPTH alone decides the meaning of the samples
        else if (word.empty())
            return fail(Exit::unreadable, "{}: its PAM header has no end", file.name);
        else
            return fail(Exit::unreadable, "{}: unknown word in its PAM header", file.name);
    }
}

Rgba8 pixel_of(const std::uint8_t* s, std::int64_t depth) {
    switch (depth) {
    case 1:
        return {s[0], s[0], s[0], 255};
    case 2:
        return {s[0], s[0], s[0], s[1]};
    case 3:
        return {s[0], s[1], s[2], 255};
    default:
        return {s[0], s[1], s[2], s[3]};
    }
}

} // namespace

Result<Image> decode_netpbm(const Source& file) {
    Words words({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    Header header;
    if (file.bytes[1] == '6') {
        header = {.width = words.number(),
                  .height = words.number(),
                  .depth = 3,
                  .max_value = words.number()};
    } else {
        TRY(header, read_pam_header(file, words));
    }
    TRY_VOID(check_size(file, header.width, header.height));
    if (header.max_value != 255 || header.depth < 1 || header.depth > 4)
        return fail(Exit::unreadable,
                    "{}: only 8 bits a sample (a maximum of 255) and 1 to 4 samples a "
                    "pixel are supported: convert it to PNG",
                    file.name);
    const std::span<const std::uint8_t> samples = file.bytes.subspan(words.samples());
    const std::int64_t needed = header.width * header.height * header.depth;
    if (static_cast<std::int64_t>(samples.size()) < needed)
        return fail(Exit::unreadable, "{}: ends early: {} bytes of pixels are there, {} are needed",
                    file.name, samples.size(), needed);
    Image image(static_cast<int>(header.width), static_cast<int>(header.height));
    const std::uint8_t* sample = samples.data();
    for (Rgba8& pixel : image.pixels()) {
        pixel = pixel_of(sample, header.depth);
        sample += header.depth;
    }
    return image;
}

} // namespace scanout::image
