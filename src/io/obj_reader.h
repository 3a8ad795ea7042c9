// The state of one OBJ file being read; obj.cpp drives it, obj_elements.cpp holds the statements
// that name vertices.
#pragma once

#include "io/cursor.h"
#include "io/obj.h"

#include <array>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace scanout::io {

class ObjReader {
public:
    ObjReader(std::string_view file, const std::string& path, Warnings& warnings,
              const std::function<bool(double)>& progress)
        : file_(file), path_(path), warnings_(warnings), progress_(progress), at_(file) {}

    Result<ObjFile> read();

private:
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
    // Index of the file -> index from 0, -1 when it names nothing. Sets forward_ when it points
    // ahead.
    std::int32_t resolve(std::int64_t index, std::size_t count);
    std::int32_t resolve_optional(std::int64_t index, std::size_t count, std::string_view what);
    void check_forward_references();
    bool check_forward_face(std::size_t face, std::size_t line);
    std::size_t line_end(std::size_t line) const;
    void all_vertices_as_points();
    bool anything_to_draw() const;

    // Every MB: progress, and room for what is still to come.
    void checkpoint();
    void reserve_ahead();
    void stop(std::string reason);
    Result<> finish();

    // One line a kind of trouble: the text is made only for the first.
    template <class... Args>
    void warn(std::string_view kind, std::size_t line, fmt::format_string<Args...> format,
              Args&&... args) {
        if (warnings_.count(kind) > 0)
            warnings_.add_more(kind, 1);
        else
            warnings_.add(kind, fmt::format("{}:{}: {}", path_, line,
                                            fmt::format(format, std::forward<Args>(args)...)));
    }
    // The word at the cursor, for messages.
    std::string word_here() const;

    std::string_view file_;
    const std::string& path_;
    Warnings& warnings_;
    const std::function<bool(double)>& progress_;

    Cursor at_;
    ObjFile out_;
    std::int32_t material_ = -1;
    std::uint32_t smoothing_ = geom::kSmoothingUnset;
    std::unordered_map<std::string, std::int32_t> material_ids_;
    std::vector<Vec3> polypaint_; // ZBrush's vertex colours, from the first vertex on
    std::vector<std::string> free_form_keywords_;
    std::size_t free_form_line_ = 0;
    std::size_t bad_positions_ = 0;

    // Elements that name a vertex before it is given: legal if it comes later.
    struct Forward {
        std::uint32_t element;
        std::size_t line;
    };
    std::vector<Forward> forward_faces_, forward_lines_, forward_points_;
    bool forward_ = false; // the corner just read points ahead

    const char* last_checkpoint_ = nullptr;
    const char* next_checkpoint_ = nullptr;
    std::array<std::size_t, 6> sizes_before_{}; // of the arrays at the last checkpoint
    std::optional<Error> stop_;
};

} // namespace scanout::io
