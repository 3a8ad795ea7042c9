// The set-up of an unclipped triangle for shading, scalar and straight from the definitions: what
// the kernels of shade/setup must give, bit for bit.
#pragma once

#include "raster/screen/primitive.h"
#include "shade/gather/gather.h"
#include "shade/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scanout::shade::test {

struct PrimitiveReference {
    Primitive p{};
    std::array<std::uint32_t, 3> v{}; // its vertices, in canonical order

    PrimitiveReference(const GatherInput& in, std::uint32_t triangle) {
        p.id = triangle;
        p.across = -1;
        const std::uint32_t* index = in.mesh->index.data() + std::size_t{triangle} * 3;
        const auto all = in.geometry->vertices();
        const std::optional<raster::SetUp> t =
            raster::set_up({all[index[0]], all[index[1]], all[index[2]]}, triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = index[t->order.vertex[k]];
            p.inverse_w[k] = in.transform->perspective ? static_cast<float>(all[v[k]].depth) : 1.0F;
        }
        set_edges(raster::edges_of(t->triangle));
        const bool behind = !t->triangle.flipped != in.mirrored; // of the canonical order
        set_attributes(in, behind, behind != t->order.odd);
    }

private:
    void set_edges(const raster::Edges& e) {
        constexpr std::int64_t kSide = std::int64_t{1} << 20, kArea = std::int64_t{1} << 30;
        p.fits_int32 = e.area < kArea;
        for (std::size_t k = 0; k < 3; ++k) {
            p.a[k] = static_cast<double>(e.a[k]);
            p.b[k] = static_cast<double>(e.b[k]);
            p.c[k] = static_cast<double>(e.c[k]);
            p.least[k] = static_cast<double>(-e.bias[k]);
            p.a_int32[k] = static_cast<std::int32_t>(e.a[k]);
            p.b_int32[k] = static_cast<std::int32_t>(e.b[k]);
            p.c_int32[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(e.c[k]));
            for (const std::int64_t step : {std::int64_t{e.a[k]}, std::int64_t{e.b[k]}})
                p.fits_int32 = p.fits_int32 && -kSide < step && step < kSide;
        }
    }

    // behind: the eye sees the side from which the vertices wind clockwise.
    void set_attributes(const GatherInput& in, bool behind_in_order, bool behind_in_file) {
        const geom::Mesh& mesh = *in.mesh;
        const Sides sides = in.frame->sides;
        const DVec3 first(mesh.position[v[0]]);
        DVec3 n = cross3(DVec3(mesh.position[v[1]]) - first, DVec3(mesh.position[v[2]]) - first);
        const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        const bool negate = behind_in_order != (sides == Sides::file && behind_in_file);
        if (largest > 0) n = n * (1 / (negate ? -largest : largest));
        for (int c = 0; c < 3; ++c)
            p.facing[c] = static_cast<float>(n[c]);
        double steepest = 0;
        for (const std::uint32_t vertex : v) {
            const double lean = dot3(DVec3(mesh.normal[vertex]), n);
            if (std::abs(lean) > std::abs(steepest)) steepest = lean;
        }
        const bool turned = sides == Sides::face  ? behind_in_file
                            : sides == Sides::eye ? steepest < 0
                                                  : false;
        const float side = turned ? -1.0F : 1.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const DVec3 place =
                (in.view->linear * DVec3(mesh.position[v[k]]) + in.view->translation) * in.unit;
            for (int c = 0; c < 3; ++c) {
                p.position[c][k] = static_cast<float>(place[c]);
                p.normal[c][k] = mesh.normal[v[k]][c] * side;
                p.colour[c][k] = mesh.colour[v[k]][c];
                if (c < 2) p.uv[c][k] = mesh.uv[v[k]][c];
            }
        }
    }
};

} // namespace scanout::shade::test
