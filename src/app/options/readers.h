// Readers of the options whose text is more than a number, a word or a file's name: each sets what
// its option says. Errors are the second half of a line, Exit::usage.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"

#include <string_view>
#include <vector>

namespace scanout::app {

std::vector<std::string_view> words_in(std::string_view text); // between spaces

Result<void> read_size(Settings& s, std::string_view text);
Result<void> read_camera(Settings& s, std::string_view text);
Result<void> read_shift(Settings& s, std::string_view text);
Result<void> read_eye(Settings& s, std::string_view text);
Result<void> read_look_at(Settings& s, std::string_view text);
Result<void> read_target(Settings& s, std::string_view text);
Result<void> read_scale(Settings& s, std::string_view text);
Result<void> read_rotate(Settings& s, std::string_view text);
Result<void> read_translate(Settings& s, std::string_view text);
Result<void> read_rotate_axis(Settings& s, std::string_view text);
Result<void> read_shear(Settings& s, std::string_view text);
Result<void> read_matrix(Settings& s, std::string_view text);
Result<void> read_about(Settings& s, std::string_view text);
Result<void> read_near(Settings& s, std::string_view text);
Result<void> read_far(Settings& s, std::string_view text);
Result<void> read_frustum(Settings& s, std::string_view text);
Result<void> read_ortho(Settings& s, std::string_view text);
Result<void> read_section(Settings& s, std::string_view text);
Result<void> read_annotate(Settings& s, std::string_view text);
Result<void> read_background(Settings& s, std::string_view text);
Result<void> read_colour(Settings& s, std::string_view text);
Result<void> read_opacity(Settings& s, std::string_view text);
Result<void> read_measure(Settings& s, std::string_view text);
Result<void> read_base_colour(Settings& s, std::string_view text);
Result<void> read_effect(Settings& s, std::string_view text);
Result<void> read_shadow_plane(Settings& s, std::string_view text);
Result<void> read_model_format(Settings& s, std::string_view text);
Result<void> read_light(Settings& s, std::string_view text);
Result<void> read_pixel_format(Settings& s, std::string_view text);
Result<void> read_json(Settings& s, std::string_view text);
Result<void> read_axis(Settings& s, std::string_view text);
Result<void> read_budget(Settings& s, std::string_view text);
Result<void> read_max_error(Settings& s, std::string_view text);
Result<void> read_sheet(Settings& s, std::string_view text);
Result<void> read_shard(Settings& s, std::string_view text);
Result<void> read_time(Settings& s, std::string_view text);
Result<void> read_frames(Settings& s, std::string_view text);
Result<void> read_limit(Settings& s, std::string_view text);
Result<void> read_made_size(Settings& s, std::string_view text);
Result<void> read_keep(Settings& s, std::string_view text);
void choose_view(Settings& s, std::size_t index);

inline constexpr std::string_view kViews = "front back left right top bottom iso"; // choose_view

} // namespace scanout::app
