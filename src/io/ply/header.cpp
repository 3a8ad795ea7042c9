#include "io/ply/header.h"

#include "io/cursor.h"
#include "io/number.h"
#include "io/text.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

// Bounds on the memory that a header can take; Gaussian splats have 62 properties.
constexpr std::size_t kMaxElements = 1000, kMaxProperties = 10000, kMaxHeaderTextures = 1000;
constexpr std::size_t kMaxHeaderBytes = std::size_t{4} << 20;

struct NamedType {
    std::string_view name;
    PlyType type;
};
constexpr std::array kPlyTypes = {
    NamedType{"char", PlyType::int8},       NamedType{"uchar", PlyType::uint8},
    NamedType{"short", PlyType::int16},     NamedType{"ushort", PlyType::uint16},
    NamedType{"int", PlyType::int32},       NamedType{"uint", PlyType::uint32},
    NamedType{"float", PlyType::float32},   NamedType{"double", PlyType::float64},
    NamedType{"int8", PlyType::int8},       NamedType{"uint8", PlyType::uint8},
    NamedType{"int16", PlyType::int16},     NamedType{"uint16", PlyType::uint16},
    NamedType{"int32", PlyType::int32},     NamedType{"uint32", PlyType::uint32},
    NamedType{"float32", PlyType::float32}, NamedType{"float64", PlyType::float64},
};

class PlyHeaderReader {
public:
    PlyHeaderReader(std::string_view file, const std::string& path, Warnings& warnings)
        : file_(file.substr(0, kMaxHeaderBytes)), path_(path), warnings_(warnings), at_(file_) {}

    Result<PlyHeader> read();

private:
    template <class... Args>
    tl::unexpected<Error> fault(fmt::format_string<Args...> format, Args&&... args) const {
        return fail(Exit::unreadable, "{}:{}: {}", path_, at_.line,
                    fmt::format(format, std::forward<Args>(args)...));
    }
    std::string_view word() {
        at_.skip_blanks();
        return at_.word();
    }
    Result<> statement(std::string_view keyword);
    Result<> format();
    Result<> element();
    Result<> property();
    Result<PlyType> type(std::string_view name) const;
    void comment();
    void warn_of_more_words(std::string_view keyword);
    void end();

    std::string_view file_;
    const std::string& path_;
    Warnings& warnings_;
    Cursor at_;
    PlyHeader header_;
    bool has_format_ = false;
    std::size_t properties_ = 0;
};

Result<PlyHeader> PlyHeaderReader::read() {
    if (!is_ply(file_))
        return fail(Exit::unreadable, "{}: not a PLY file: it does not begin with 'ply'", path_);
    at_.skip_to_line_end(file_.size());
    at_.next_line();
    for (; !at_.done(); at_.next_line()) {
        const std::string_view keyword = word();
        if (keyword == "end_header") {
            if (!has_format_) return fault("the header ends without a 'format' line");
            end();
            return std::move(header_);
        }
        TRY_VOID(statement(keyword));
        at_.skip_to_line_end(file_.size());
    }
    return fail(Exit::unreadable, "{}: the header has no end ('end_header')", path_);
}

Result<> PlyHeaderReader::statement(std::string_view keyword) {
    if (keyword.empty()) return {};
    if (keyword == "comment" || keyword == "obj_info") {
        comment();
        return {};
    }
    if (keyword == "format") return format();
    if (!has_format_)
        return fault("'{}' stands where the 'format' line belongs, behind 'ply'", shown(keyword));
    if (keyword == "element") return element();
    if (keyword == "property") return property();
    warnings_.add("ply statement",
                  fmt::format("{}:{}: '{}' is no statement of a PLY header; it is left out", path_,
                              at_.line, shown(keyword)));
    return {};
}

Result<> PlyHeaderReader::format() {
    const std::string_view name = word();
    if (name == "ascii")
        header_.encoding = PlyEncoding::ascii;
    else if (name == "binary_little_endian")
        header_.encoding = PlyEncoding::little_endian;
    else if (name == "binary_big_endian")
        header_.encoding = PlyEncoding::big_endian;
    else
        return fault("format '{}' is not known; known are ascii, binary_little_endian and "
                     "binary_big_endian",
                     shown(name));
    has_format_ = true;
    if (const std::string_view version = word(); version != "1.0")
        warnings_.add("ply version", fmt::format("{}:{}: version '{}' is read like 1.0", path_,
                                                 at_.line, shown(version)));
    return {};
}

Result<> PlyHeaderReader::element() {
    const std::string name(word());
    if (name.empty()) return fault("an element without a name");
    at_.skip_blanks();
    std::int64_t count = 0;
    if (!read_integer(at_.at, at_.end, count) || !at_.at_word_end() || count < 0)
        return fault("element '{}' has no count that is a whole number from 0 on", shown(name));
    if (header_.elements.size() == kMaxElements)
        return fault("more than {} elements", kMaxElements);
    header_.elements.push_back({name, static_cast<std::uint64_t>(count), {}});
    warn_of_more_words("element");
    return {};
}

Result<> PlyHeaderReader::property() {
    if (header_.elements.empty()) return fault("a property stands before any element");
    if (++properties_ > kMaxProperties) return fault("more than {} properties", kMaxProperties);
    PlyProperty property;
    std::string_view name = word();
    if (name == "list") {
        TRY(const PlyType length, type(word()));
        if (length == PlyType::float32 || length == PlyType::float64)
            return fault("the length of a list is no whole number");
        property.list_length_type = length;
        name = word();
    }
    TRY(property.type, type(name));
    property.name = word();
    if (property.name.empty()) return fault("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
    warn_of_more_words("property");
    return {};
}

Result<PlyType> PlyHeaderReader::type(std::string_view name) const {
    for (const NamedType& known : kPlyTypes)
        if (known.name == name) return known.type;
    return fault("type '{}' is not known; known are char uchar short ushort int uint float double",
                 shown(name));
}

void PlyHeaderReader::comment() {
    if (lower_case(word()) != "texturefile") return;
    std::string name = at_.rest();
    if (!name.empty() && header_.textures.size() < kMaxHeaderTextures)
        header_.textures.push_back({std::move(name), at_.line});
}

void PlyHeaderReader::warn_of_more_words(std::string_view keyword) {
    if (const std::string_view more = word(); !more.empty())
        warnings_.add("ply header words",
                      fmt::format("{}:{}: '{}' behind the {}'s statement is not read", path_,
                                  at_.line, shown(more), keyword));
}

// The body begins behind one line end. If that is a carriage return, the file's first line tells
// whether a line feed belongs to it: a binary body may begin with that byte.
void PlyHeaderReader::end() {
    at_.skip_to_line_end(file_.size());
    const std::size_t first = std::min(file_.find_first_of("\r\n"), file_.size() - 1);
    const bool cr_alone =
        file_[first] == '\r' && first + 1 < file_.size() && file_[first + 1] != '\n';
    header_.body_line = at_.line + 1;
    if (!at_.done() && *at_.at == '\r' && cr_alone)
        ++at_.at;
    else
        at_.next_line();
    header_.body = static_cast<std::size_t>(at_.at - file_.data());
}

} // namespace

std::size_t size_of(PlyType type) {
    constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::find(std::span<const std::string_view> names) const {
    for (const std::string_view wanted : names)
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (properties[i].name == wanted) return i;
    return std::nullopt;
}

bool PlyElement::has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& p) { return p.list_length_type.has_value(); });
}

std::size_t PlyElement::least_row_bytes() const {
    std::size_t bytes = 0;
    for (const PlyProperty& p : properties)
        bytes += size_of(p.list_length_type.value_or(p.type));
    return bytes;
}

Result<PlyHeader> read_ply_header(std::string_view file, const std::string& path,
                                  Warnings& warnings) {
    return PlyHeaderReader(file, path, warnings).read();
}

} // namespace scanout::io
