#include "formula/formula.h"

#include "formula/makers.h"

#include <algorithm>
#include <array>

namespace scanout::formula {
namespace {

constinit const std::array<Formula, 8> kFormulas{
    {{"zone_plate", "waves that get finer outwards: where aliasing begins", "rings", 1, 5000, 200,
      200, false, false, zone_plate_picture, zone_plate_model},
     {"checker", "a board of squares; the model lies on the ground, to the horizon",
      "squares a side", 1, 1000, 8, 128, false, false, checker_picture, checker_model},
     {"terrain", "mountains by midpoint displacement; as a picture, their heights", "octaves", 1,
      16, 16, 16, true, true, terrain_picture, terrain_model},
     {"mandelbrot", "how soon z z + c leaves; as a model, a height field", "iterations", 1, 100000,
      256, 256, true, false, mandelbrot_picture, mandelbrot_model},
     {"koch", "a snowflake of equal sides", "recursions", 0, 10, 6, 6, false, false, koch_picture,
      koch_model},
     {"fern", "points of an iterated function system", "thousand points", 1, 100000, 4000, 100,
      false, true, fern_picture, fern_model},
     {"sierpinski", "a triangle of three of itself, by points", "thousand points", 1, 100000, 4000,
      100, false, true, sierpinski_picture, sierpinski_model},
     {"dragon", "a curve of two of itself, by points", "thousand points", 1, 100000, 4000, 100,
      false, true, dragon_picture, dragon_model}}};

} // namespace

std::span<const Formula> formulas() {
    return kFormulas;
}

const Formula* find_formula(std::string_view name) {
    const auto* const found = std::find_if(kFormulas.begin(), kFormulas.end(),
                                           [&](const Formula& f) { return f.name == name; });
    return found == kFormulas.end() ? nullptr : found;
}

std::int64_t vertices_of(const Formula& formula, const Wanted& wanted) {
    const std::int64_t detail = wanted.detail;
    if (formula.height_field) return std::int64_t{wanted.width} * wanted.height;
    if (formula.name == "zone_plate") return 512 * detail;
    if (formula.name == "checker") return 4 * detail * detail;
    if (formula.name == "koch") return std::int64_t{3} << (2 * detail);
    return 1000 * detail;
}

} // namespace scanout::formula
