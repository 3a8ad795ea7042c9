// Word by word: a facet is three times "vertex X Y Z" between "facet" and "endfacet", in any case
// and layout; everything else (normals, loops, colours) is passed over. A name stands behind solid
// and endsolid, up to the line's end.
#include "io/cursor.h"
#include "io/stl/reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

bool is_word(std::string_view word, std::string_view lower) {
    return word.size() == lower.size() &&
           std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
               return a == b || (a >= 'A' && a <= 'Z' && a + 32 == b);
           });
}

std::string_view without_mark(std::string_view file) {
    if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
    return file;
}

bool begins_with_facet(std::string_view line) {
    Cursor cursor(line);
    while (!cursor.done() && Cursor::is_blank(*cursor.at))
        ++cursor.at;
    constexpr std::size_t kLongest = 6; // of a word that is looked at
    const std::string_view word(cursor.at, static_cast<std::size_t>(cursor.end - cursor.at));
    return is_word(Cursor(word.substr(0, kLongest)).word(), "facet");
}

class FacetReader {
public:
    FacetReader() : cursor_(std::string_view()) {}
    FacetReader(std::string_view text, const std::string& path, StlCollector* collector)
        : cursor_(text), path_(&path), collector_(collector) {}

    // Reads up to `end`, or some bytes further; at the text's end, too.
    void read_to(const char* end) {
        while (cursor_.at < end)
            word();
    }
    // Takes over what another one has read of a part.
    void take(const FacetReader& part) {
        triangles_.insert(triangles_.end(), part.triangles_.begin(), part.triangles_.end());
        cursor_.at = part.cursor_.at;
        cursor_.line += part.cursor_.line - 1;
    }
    void finish() {
        if (open_ && fault_.empty() && vertices_ == 3 && more_follows_)
            triangles_.push_back(triangle_); // else the file may end within its last number
        else if (open_)
            skip(fault_.empty() ? "the file ends within a facet" : fault_);
        open_ = false;
    }

    const char* at() const { return cursor_.at; }
    std::string_view rest() const {
        return {cursor_.at, static_cast<std::size_t>(cursor_.end - cursor_.at)};
    }
    bool open() const { return open_; } // within a facet
    bool plain() const { return !open_ && !skipped_ && cursor_.done(); }
    std::vector<StlTriangle>& triangles() { return triangles_; }

private:
    void word() {
        cursor_.skip_blanks();
        if (cursor_.at_line_end()) {
            cursor_.next_line();
            return;
        }
        const std::string_view word = cursor_.word();
        more_follows_ = vertices_ == 3;
        if (is_word(word, "vertex"))
            vertex();
        else if (is_word(word, "facet"))
            begin_facet();
        else if (is_word(word, "endfacet"))
            end_facet();
        else if (is_word(word, "solid") || is_word(word, "endsolid"))
            name();
    }

    // A name stands behind solid and endsolid, up to the line's end, or up to a facet on its line.
    void name() {
        while (!cursor_.at_line_end()) {
            cursor_.skip_blanks();
            const Cursor before = cursor_;
            if (is_word(cursor_.word(), "facet")) {
                cursor_.skip_blanks();
                const bool facet = is_word(cursor_.word(), "normal"); // a name may hold the word
                cursor_ = before;
                if (facet) return;
                cursor_.word();
            }
            if (cursor_.at == before.at) return; // a continued line
        }
    }

    void begin_facet() {
        if (open_ && fault_.empty() && vertices_ == 3)
            triangles_.push_back(triangle_); // its 'endfacet' is missing, which takes nothing away
        else if (open_ && (vertices_ > 0 || !fault_.empty())) // "end facet" opens an empty one
            skip(fault_.empty() ? fmt::format("a facet of {} vertices, not three", vertices_)
                                : fault_);
        open_ = true;
        vertices_ = 0;
        fault_.clear();
        fault_line_ = cursor_.line;
    }

    void vertex() {
        if (!open_) {
            begin_facet();
            fault("a vertex outside of a facet");
        }
        DVec3 v(0);
        for (int axis = 0; axis < 3; ++axis) {
            cursor_.skip_blanks();
            const NumberFault f = cursor_.number(v[axis]);
            if (f == NumberFault::none) continue;
            const bool comma = !cursor_.at_line_end() && cursor_.number_before_comma();
            fault(f == NumberFault::too_large ? "the number is too large"
                  : comma                     ? "a decimal comma: numbers have a point"
                                              : "a vertex has three numbers");
            cursor_.skip_to_line_end(rest().size());
            return;
        }
        if (vertices_ < 3) triangle_[vertices_] = v;
        ++vertices_;
    }

    void end_facet() {
        if (open_ && fault_.empty() && vertices_ == 3)
            triangles_.push_back(triangle_);
        else if (open_ && fault_.empty())
            skip(fmt::format("a facet of {} vertices, not three", vertices_));
        else
            skip(open_ ? fault_ : "an 'endfacet' without 'facet'");
        open_ = false;
    }

    // The first fault of a facet is the one that is told, with its own line.
    void fault(const char* what) {
        if (!fault_.empty()) return;
        fault_ = what;
        fault_line_ = cursor_.line;
    }

    void skip(std::string_view what) {
        skipped_ = true;
        if (collector_ == nullptr) {
            cursor_.at = cursor_.end; // the part is read again
            return;
        }
        if (!open_) fault_line_ = cursor_.line;
        collector_->skip(fmt::format("{}:{}: {}: facet skipped", *path_, fault_line_, what));
    }

    Cursor cursor_;
    const std::string* path_ = nullptr;
    StlCollector* collector_ = nullptr; // null: of a part
    std::vector<StlTriangle> triangles_;
    bool open_ = false;
    bool skipped_ = false; // some facet
    std::size_t vertices_ = 0;
    bool more_follows_ = false; // some word behind the facet's three vertices
    StlTriangle triangle_{};
    std::string fault_; // of this facet
    std::size_t fault_line_ = 0;
};

// The file as a whole: parts on all cores, and what they cannot tell from beginning to end.
class AsciiReader {
public:
    AsciiReader(std::string_view file, const std::string& path, StlCollector& collector,
                const Reading& how)
        : whole_(without_mark(file), path, &collector), path_(path), collector_(collector),
          parts_(how) {}

    std::size_t left() const { return whole_.rest().size(); }

    // Reads some of the file; false at its end.
    bool step() {
        const std::string_view rest = whole_.rest();
        const auto texts =
            whole_.open() ? std::vector<std::string_view>() : parts_.next(rest, begins_with_facet);
        if (texts.empty())
            whole_.read_to(rest.data() + std::min(rest.size(), parts_.part_bytes()));
        else
            read_parts(texts);
        if (left() == 0) whole_.finish();
        constexpr std::size_t kMany = 32768; // so that all cores have enough to do
        if (whole_.triangles().size() >= kMany || left() == 0) {
            collector_.add(whole_.triangles());
            whole_.triangles().clear();
        }
        return left() > 0;
    }

private:
    void read_parts(const std::vector<std::string_view>& texts) {
        readers_.resize(std::max(readers_.size(), texts.size()));
        for_chunks(parts_.jobs(), texts.size(), 1, [&](std::size_t i, std::size_t, int) {
            std::vector<StlTriangle> emptied = std::move(readers_[i].triangles());
            emptied.clear();
            readers_[i] = FacetReader(texts[i], path_, nullptr);
            readers_[i].triangles() = std::move(emptied);
            readers_[i].read_to(texts[i].data() + texts[i].size());
        });
        std::size_t read_again = 0;
        for (std::size_t i = 0; i < texts.size(); ++i) {
            if (readers_[i].plain() && !whole_.open() && whole_.at() == texts[i].data()) {
                whole_.take(readers_[i]);
            } else {
                whole_.read_to(texts[i].data() + texts[i].size());
                ++read_again;
            }
        }
        parts_.read_again(read_again, texts.size());
    }

    FacetReader whole_;
    const std::string& path_;
    StlCollector& collector_;
    TextParts parts_;
    std::vector<FacetReader> readers_; // of parts; kept for their room
};

} // namespace

// A binary file has a zero byte near its start: in its count, its coordinates or its attributes.
bool begins_like_ascii_stl(std::string_view file) {
    Cursor cursor(without_mark(file).substr(0, 1024));
    while (cursor.at_line_end() && !cursor.done())
        cursor.next_line();
    cursor.skip_blanks();
    const std::string_view word = cursor.word();
    const std::string_view head = file.substr(0, 1024);
    const std::size_t last = head.find_last_not_of('\0');   // zeros may stand behind the end
    const bool solid = is_word(word.substr(0, 5), "solid"); // "solid_t" is seen, too
    return (solid || is_word(word, "facet")) &&
           head.substr(0, last + 1).find('\0') == std::string_view::npos;
}

Result<StlResult> read_ascii_stl(std::string_view file, const std::string& path, Warnings& warnings,
                                 const std::function<bool(double)>& progress, const Reading& how) {
    // A facet has 150 to 280 characters.
    StlCollector collector(*how.jobs, path, warnings, file.size() / 256);
    AsciiReader reader(file, path, collector, how);
    while (reader.step())
        TRY_VOID(report(progress, file.size() - reader.left(), file.size(), path));
    return collector.finish();
}

} // namespace scanout::io
