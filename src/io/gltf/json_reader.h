// Typed access to the JSON of a glTF file, over simdjson's tape. The first fault is kept and every
// later value is a default: the callers read on without a check a value, and ask for outcome()
// once. Included by gltf_json.cpp alone: simdjson's header is large.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/document.h"
#include "io/text.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <simdjson.h>

namespace scanout::io::gltf {

// A value that may be missing.
class Json {
public:
    Json() = default;
    explicit Json(simdjson::dom::element value) : value_(value) {}
    bool there() const { return value_.has_value(); }
    const simdjson::dom::element& operator*() const { return *value_; }

private:
    std::optional<simdjson::dom::element> value_;
};

class JsonReader {
public:
    JsonReader(const std::string& path, Warnings& warnings) : path_(path), warnings_(warnings) {}

    // The outermost object. The text's memory is not needed afterwards.
    Json parse(std::string_view text) {
        if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
        simdjson::dom::element root;
        // simdjson reads a few bytes beyond the end: it copies the text to where it may. It takes
        // no null pointer, which an empty file has.
        const char* const data = text.empty() ? "" : text.data();
        const auto error = parser_.parse(data, text.size(), true).get(root);
        if (error != simdjson::SUCCESS) {
            fault(fmt::format("its JSON cannot be read: {}", reason(error)));
            return {};
        }
        simdjson::dom::object fields;
        if (root.get(fields) != simdjson::SUCCESS) {
            fault("its JSON is no object");
            return {};
        }
        for (const auto field : fields)
            if (simdjson::dom::array array; field.value.get(array) == simdjson::SUCCESS)
                sizes_.try_emplace(std::string(field.key), count_of(array));
        return Json(root);
    }

    void fault(std::string what) {
        if (!fault_) fault_ = std::move(what);
    }
    void fault_at(std::string_view key, std::string_view what) {
        if (!fault_) fault_ = fmt::format("{} {}", place(key), what);
    }
    Result<> outcome() const {
        if (fault_) return fail(Exit::unreadable, "{}: {}", path_, *fault_);
        return {};
    }

    std::size_t size_of(std::string_view array) const { // of the outermost object
        const auto found = sizes_.find(array);
        return found == sizes_.end() ? 0 : found->second;
    }

    // Null is as good as none.
    Json field(const Json& of, std::string_view key) const {
        simdjson::dom::element value;
        if (!of.there() || (*of)[key].get(value) != simdjson::SUCCESS || value.is_null()) return {};
        return Json(value);
    }
    bool has(const Json& of, std::string_view key) const { return field(of, key).there(); }

    Json object(const Json& of, std::string_view key) {
        const Json value = field(of, key);
        if (!value.there() || (*value).is_object()) return value;
        fault_at(key, "is no object");
        return {};
    }
    Json extension(const Json& of, std::string_view name) {
        return object(object(of, "extensions"), name);
    }

    std::string text(const Json& of, std::string_view key) {
        const Json value = field(of, key);
        return value.there() ? text_of(value, key) : "";
    }
    std::string text_of(const Json& value, std::string_view key) {
        std::string_view text;
        if ((*value).get(text) != simdjson::SUCCESS) fault_at(key, "is no text");
        return std::string(text);
    }

    bool flag(const Json& of, std::string_view key) {
        const Json value = field(of, key);
        bool flag = false;
        if (value.there() && (*value).get(flag) != simdjson::SUCCESS)
            fault_at(key, "is neither true nor false");
        return flag;
    }

    double number(const Json& of, std::string_view key, double otherwise) {
        const Json value = field(of, key);
        return value.there() ? number_of(value, key) : otherwise;
    }

    std::uint64_t whole(const Json& of, std::string_view key, std::uint64_t otherwise,
                        std::uint64_t most) {
        const Json value = field(of, key);
        return value.there() ? whole_of(value, key, most) : otherwise;
    }
    std::uint64_t whole_of(const Json& value, std::string_view key, std::uint64_t most) {
        if (const auto whole = whole_if_any(value, most)) return *whole;
        fault_at(key, fmt::format("is {}", no_whole(most)));
        return 0;
    }

    // Exactly `count` numbers, where the key is there.
    void numbers(const Json& of, std::string_view key, double* out, std::size_t count) {
        const Json value = field(of, key);
        if (!value.there()) return;
        simdjson::dom::array array;
        if ((*value).get(array) != simdjson::SUCCESS || count_of(array) != count)
            return fault_at(key, fmt::format("is no array of {} numbers", count));
        for (const simdjson::dom::element one : array)
            *out++ = number_of(Json(one), key);
    }

    // An index into an array of the outermost object; -1 where the key is missing.
    Index index(const Json& of, std::string_view key, std::string_view array) {
        const Json value = field(of, key);
        return value.there() ? index_of(value, key, array) : -1;
    }
    Index index_of(const Json& value, std::string_view key, std::string_view array) {
        const std::uint64_t index = whole_of(value, key, kMostIndex);
        if (index < size_of(array)) return static_cast<Index>(index);
        fault_at(key, fmt::format("is {}", beyond(index, array)));
        return -1;
    }
    // The same of what may never be read: its fault is kept in `fault`, where that has none.
    Index index(const Json& of, std::string_view key, std::string_view array, std::string& fault) {
        const Json value = field(of, key);
        return value.there() ? index_of(value, key, array, fault) : -1;
    }
    Index index_of(const Json& value, std::string_view key, std::string_view array,
                   std::string& fault) {
        const auto index = whole_if_any(value, kMostIndex);
        if (index && *index < size_of(array)) return static_cast<Index>(*index);
        if (fault.empty())
            fault = fmt::format("{} is {}", shown(key),
                                index ? beyond(*index, array) : no_whole(kMostIndex));
        return -1;
    }
    // The same of what may be left out: -1, with a warning, where it is beyond the array's end.
    Index soft_index(const Json& of, std::string_view key, std::string_view array) {
        const Json value = field(of, key);
        if (!value.there()) return -1;
        const std::uint64_t index = whole_of(value, key, kMostIndex);
        if (index < size_of(array)) return static_cast<Index>(index);
        if (!fault_)
            warnings_.add(fmt::format("glTF reference {}", key),
                          fmt::format("{}: {} is {}; drawn without", path_, place(key),
                                      beyond(index, array)));
        return -1;
    }

    // What is read while this lives is of a part of the object: messages name it, too.
    class Within {
    public:
        Within(JsonReader& in, std::string part)
            : in_(in), outer_(std::exchange(in.part_, std::move(part))) {}
        ~Within() { in_.part_ = outer_; }
        Within(const Within&) = delete;
        Within& operator=(const Within&) = delete;

    private:
        JsonReader& in_;
        std::string outer_;
    };

    // Each object of an array of the outermost object: messages name its place.
    template <class Visit>
    void each_top(const Json& root, std::string_view key, Visit&& visit) {
        array_ = key;
        number_ = 0;
        each(root, key, [&](Json value) {
            if ((*value).is_object())
                visit(value);
            else
                fault(fmt::format("{}[{}] is no object", key, number_));
            ++number_;
        });
        array_ = {};
    }
    template <class Visit>
    void each(const Json& of, std::string_view key, Visit&& visit) {
        const Json value = field(of, key);
        if (!value.there()) return;
        simdjson::dom::array array;
        if ((*value).get(array) != simdjson::SUCCESS) return fault_at(key, "is no array");
        for (const simdjson::dom::element one : array) {
            if (fault_) return;
            visit(Json(one));
        }
    }
    template <class Visit>
    void each_field(const Json& of, Visit&& visit) {
        simdjson::dom::object object;
        if (!of.there() || (*of).get(object) != simdjson::SUCCESS) return;
        for (const auto field : object)
            if (!field.value.is_null()) visit(std::string_view(field.key), Json(field.value));
    }

private:
    static constexpr std::uint64_t kMostIndex = 0x7fffffff;

    static std::optional<std::uint64_t> whole_if_any(const Json& value, std::uint64_t most) {
        std::uint64_t whole = 0;
        if ((*value).get(whole) == simdjson::SUCCESS && whole <= most) return whole;
        double number = -1; // 3.0 is whole, too
        if ((*value).get(number) == simdjson::SUCCESS && number >= 0 &&
            number <= static_cast<double>(most) && number == std::floor(number))
            return static_cast<std::uint64_t>(number);
        return std::nullopt;
    }
    static std::string no_whole(std::uint64_t most) {
        return fmt::format("no whole number from 0 to {}", most);
    }
    // The array's own size() stops at 2^24.
    static std::size_t count_of(const simdjson::dom::array& array) {
        std::size_t count = 0;
        for ([[maybe_unused]] const simdjson::dom::element one : array)
            ++count;
        return count;
    }
    static std::string_view reason(simdjson::error_code error) {
        switch (error) {
        case simdjson::EMPTY:
            return "it is empty";
        case simdjson::DEPTH_ERROR:
            return "it is nested too deeply";
        case simdjson::UTF8_ERROR:
            return "it is no UTF-8";
        case simdjson::NUMBER_ERROR:
            return "a number in it is none, or too large";
        case simdjson::UNCLOSED_STRING:
            return "a text in it has no end";
        case simdjson::CAPACITY:
            return "it is longer than 4 GB";
        case simdjson::MEMALLOC:
            return "memory ran out";
        default:
            return "it is cut short, or no JSON";
        }
    }
    double number_of(const Json& value, std::string_view key) {
        double number = 0;
        if ((*value).get(number) != simdjson::SUCCESS) fault_at(key, "is no number");
        return number;
    }
    std::string place(std::string_view key) const {
        if (array_.empty()) return shown(key);
        return fmt::format("{}[{}].{}{}{}", array_, number_, part_, part_.empty() ? "" : ".",
                           shown(key));
    }
    std::string beyond(std::uint64_t index, std::string_view array) const {
        return fmt::format("{}, and there are {} {}", index, size_of(array), array);
    }

    const std::string& path_;
    Warnings& warnings_;
    simdjson::dom::parser parser_;
    std::map<std::string, std::size_t, std::less<>> sizes_;
    std::optional<std::string> fault_;
    std::string_view array_; // of the object that is read
    std::size_t number_ = 0;
    std::string part_; // of that object
};

} // namespace scanout::io::gltf
