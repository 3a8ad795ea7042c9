// The state of one OBJ file being read; obj.cpp drives it, obj_elements.cpp holds the statements
// that name vertices, obj_parts.cpp puts parts together that were read beside each other.
#pragma once

#include "io/cursor.h"
#include "io/obj/obj.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace scanout::io {

// What the reader of a part says of it: what hangs on what stands before the part.
struct ObjPart {
    bool plain = true; // no fault, and nothing out of the ordinary
    struct Indices {
        bool from_start = false, from_end = false; // in which ways the file counts
        std::int64_t ahead = 0;  // of indices from the start: how far beyond the part's own
        std::int64_t before = 0; // of indices from the end: how far before the part's begin
    };
    std::array<Indices, 3> indices; // of positions, uvs, normals
    // What comes before the part's first usemtl, and its first s.
    std::optional<std::array<std::size_t, 3>> before_material; // faces, lines, points
    std::optional<std::size_t> before_smoothing;               // faces
};

class ObjReader {
public:
    ObjReader(std::string_view file, const std::string& path, Warnings& warnings,
              const std::function<bool(double)>& progress, const Reading& how)
        : file_(file), path_(path), warnings_(warnings), progress_(progress), parts_(how),
          notes_lines_(how.lines), at_(file) {}

    Result<ObjFile> read();

private:
    void read_to(const char* end); // statements that begin before it
    void statement();
    void vertex_statement();
    void other_statement();
    void free_form_statement(std::string_view keyword);
    void finish_statement();

    // The first numbers of the statement, and why there are no more (none: the statement ends, or N
    // are read).
    template <std::size_t N>
    struct Numbers {
        double value[N];
        std::size_t count = 0;
        NumberFault fault = NumberFault::none;
    };
    template <std::size_t N>
    Numbers<N> numbers();
    void position();
    void colour(const Numbers<7>& given);
    void texture_coordinate();
    void normal();
    void number_fault(std::string_view what, NumberFault fault, int wanted);
    void comment();
    void polypaint();
    void smoothing();
    void use_material();

    // obj_elements.cpp
    void face();
    void polyline();
    void points();
    bool corner(geom::Corner& corner);
    enum Named : std::size_t { named_position, named_uv, named_normal, named_count };
    // Index of the file -> index from 0, -1 when it names nothing. Sets doubtful_ when it points
    // ahead.
    std::int32_t resolve(std::int64_t index, std::size_t count, Named named);
    std::int32_t resolve_optional(std::int64_t index, std::size_t count, Named named);
    // Takes out the doubtful elements that turn out to be unusable.
    void check_doubtful();
    bool check_doubtful_face(std::size_t face, std::size_t line);
    // False, with a warning, when `what` cannot be drawn with this vertex.
    bool check_vertex(std::int64_t vertex, std::string_view what, std::size_t line);
    std::size_t line_end(std::size_t line) const;

    // obj_parts.cpp
    // Reads some parts at once; false when there are none to be had.
    bool read_parts();
    void read_part(std::string_view text);   // as if nothing stood before it
    bool takes(const ObjReader& part) const; // what the part says holds behind what was read
    void take(const ObjReader& part);
    void take_vertices(const ObjReader& part);
    void note_line(std::vector<std::uint32_t>& lines, std::size_t line) const {
        if (notes_lines_) lines.push_back(static_cast<std::uint32_t>(line));
    }
    void take_elements(const ObjReader& part);
    void take_smoothing(const ObjReader& part);
    std::int32_t resolve_in_part(std::int64_t index, std::size_t count, Named named);
    void note_material_in_part();

    // Every MB: progress, and room for what is still to come.
    void checkpoint();
    void reserve_ahead();
    void stop(std::string reason);
    Result<> finish();

    // One message a kind of trouble, that of the lowest line: what is found out at the file's end
    // may stand before what was seen at once. The text is made only when it is the one.
    template <class... Args>
    void warn(std::string_view kind, std::size_t line, fmt::format_string<Args...> format,
              Args&&... args) {
        if (part_) {
            part_->plain = false;
            return;
        }
        const auto known = std::find_if(faults_.begin(), faults_.end(),
                                        [&](const Fault& f) { return f.kind == kind; });
        Fault& fault =
            known != faults_.end() ? *known : faults_.emplace_back(Fault{kind, line, {}, 0});
        if (fault.count++ > 0 && fault.line <= line) return;
        fault.line = line;
        fault.text = fmt::format(format, std::forward<Args>(args)...);
    }
    // Hands the messages on, in the order of their lines.
    void tell_faults();
    // The word at the cursor, for messages.
    std::string word_here() const;

    std::string_view file_;
    const std::string& path_;
    Warnings& warnings_;
    const std::function<bool(double)>& progress_;
    TextParts parts_;
    bool notes_lines_;                                     // Reading::lines
    std::vector<std::unique_ptr<ObjReader>> part_readers_; // kept for their room

    Cursor at_;
    ObjFile out_;
    std::int32_t material_ = -1;
    std::uint32_t smoothing_ = geom::kSmoothingUnset;
    std::unordered_map<std::string, std::int32_t> material_ids_;
    std::vector<Vec3> polypaint_; // ZBrush's vertex colours, from the first vertex on
    std::vector<std::string> free_form_keywords_;
    std::size_t free_form_line_ = 0;
    std::size_t bad_positions_ = 0;

    // Elements that are judged at the file's end: they name something before it is given, which is
    // legal if it comes later, or a vertex that could not be read.
    struct Doubtful {
        std::uint32_t element;
        std::size_t line;
    };
    std::vector<Doubtful> doubtful_faces_, doubtful_lines_, doubtful_points_;
    bool doubtful_ = false; // the element being read is

    struct Fault {
        std::string_view kind; // outlives the reader: a literal
        std::size_t line;
        std::string text;
        std::size_t count;
    };
    std::vector<Fault> faults_;

    std::optional<ObjPart> part_; // of the reader of a part

    const char* last_checkpoint_ = nullptr;
    const char* next_checkpoint_ = nullptr;
    std::array<std::size_t, 6> sizes_before_{}; // of the arrays at the last checkpoint
    std::optional<Error> stop_;
};

} // namespace scanout::io
