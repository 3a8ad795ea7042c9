// Pictures and models by a formula, of any size: what shows aliasing (a zone plate, a checker board
// to the horizon), and fractals, whose detail has no end: they are test models that scale. The same
// numbers give the same bits on every machine.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"
#include "image/image.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace scanout::formula {

struct Wanted {
    int width = 512, height = 512; // pixels; of a height field: vertices along x and z
    int detail = 1;                // what it is: Formula::detail
    std::uint64_t seed = 1;        // of those that are drawn by chance
};

using Progress = std::function<void(double)>; // gets a share from 0 to 1 now and then

struct Formula {
    std::string_view name, blurb;
    std::string_view detail; // what there are so many of
    int least, most, of_picture, of_model;
    bool height_field; // a model of width x height vertices
    bool seeded;
    image::Image (*picture)(const Wanted& wanted, Jobs& jobs, const Progress& progress);
    geom::PolygonMesh (*model)(const Wanted& wanted, Jobs& jobs, const Progress& progress);
};

std::span<const Formula> formulas();
const Formula* find_formula(std::string_view name); // null: there is none

// About how many vertices the model has.
std::int64_t vertices_of(const Formula& formula, const Wanted& wanted);

} // namespace scanout::formula
