#include "frame/pass/ambient_occlusion.h"

#include "raster/screen/primitive.h"
#include "shade/ambient_occlusion/blur.h"
#include "shade/ambient_occlusion/horizon.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

constexpr int kBand = 8; // rows of a job

Vec3 normal_of(const geom::Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* index = mesh.index.data() + triangle * 3;
    const auto corner = [&](int i) { return DVec3(mesh.position[index[i]]); };
    const DVec3 normal = cross3(corner(1) - corner(0), corner(2) - corner(0));
    const double length = std::sqrt(dot3(normal, normal));
    return length > 0 ? Vec3(normal / length) : Vec3(0);
}

// By what the view lengthens the model.
double scale_of(const scene::View& view) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, dot3(view.linear[i], view.linear[i]));
    return std::sqrt(most);
}

} // namespace

std::size_t AmbientOcclusionPass::at(int x, int y) const {
    return static_cast<std::size_t>(shade::SurfaceImage::kBeside) +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(surface_.stride) +
           static_cast<std::size_t>(x);
}

void AmbientOcclusionPass::set_size(int width, int height) {
    if (surface_.width == width && surface_.height == height) return;
    constexpr int kBeside = shade::SurfaceImage::kBeside;
    surface_.width = image_.width = width;
    surface_.height = image_.height = height;
    surface_.stride = image_.stride = (width + 2 * kBeside - 1) / kBeside * kBeside;
    const std::size_t size = at(0, height) + kBeside;
    distance_ = LargeArray<float>(size, shade::SurfaceImage::kNowhere);
    triangle_ = LargeArray<std::uint32_t>(size, 0);
    open_ = LargeArray<float>(size, 1.0F);
    between_ = LargeArray<float>(size, 1.0F);
    surface_.distance = image_.distance = distance_.data() + kBeside;
    surface_.triangle = triangle_.data() + kBeside;
    image_.open = open_.data() + kBeside;
}

void AmbientOcclusionPass::begin(Jobs& jobs, const scene::Scene& scene, const scene::View& view,
                                 int width, int height) {
    set_size(width, height);
    const geom::Mesh& mesh = scene.mesh;
    const std::uint64_t revision = scene.mesh_revision();
    if (revision == 0 || revision != revision_ || normals_.size() != mesh.triangles()) {
        revision_ = revision;
        normals_.resize(mesh.triangles());
        constexpr std::size_t kPart = 4096;
        jobs.for_each(static_cast<int>((normals_.size() + kPart - 1) / kPart), [&](int part, int) {
            const std::size_t first = static_cast<std::size_t>(part) * kPart;
            for (std::size_t t = first; t < std::min(first + kPart, normals_.size()); ++t)
                normals_[t] = normal_of(mesh, t);
        });
    }
    surface_.normal = &normals_.front().x;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            surface_.normal_matrix[r][c] = static_cast<float>(view.normal[c][r]);
    perspective_ = view.projection == scene::Projection::perspective;
    surface_.orthographic = !perspective_;
    const double unit = scene::to_floats(view), place = perspective_ ? 1 : unit;
    surface_.scale_x = static_cast<float>(2 * view.half_width / width * place);
    surface_.offset_x = static_cast<float>((view.middle.x - view.half_width) * place);
    surface_.scale_y = static_cast<float>(-2 * view.half_height / height * place);
    surface_.offset_y = static_cast<float>((view.middle.y + view.half_height) * place);
    surface_.radius =
        static_cast<float>(shade::kOcclusionRadius * mesh.radius * scale_of(view) * unit);
    image_.apart = surface_.radius / 4;
    nearest_ = view.near_distance * unit;
    origin_ = view.depth_origin * unit;
    per_depth_ = perspective_ ? 0 : unit / view.depth_scale;
}

void AmbientOcclusionPass::take(const raster::VisibilityTile& tile) {
    const image::Rect& area = tile.area();
    for (int y = area.y0; y < area.y1; ++y) {
        float* const distance = distance_.data() + at(0, y);
        std::uint32_t* const triangle = triangle_.data() + at(0, y);
        for (int x = area.x0; x < area.x1; ++x) {
            const std::uint32_t id = tile.id(x, y);
            const bool seen = id != raster::kNoPrimitive;
            const double depth{tile.depth(x, y)};
            triangle[x] = seen ? id : 0;
            distance[x] = !seen          ? shade::SurfaceImage::kNowhere
                          : perspective_ ? static_cast<float>(nearest_ / depth)
                                         : static_cast<float>(-(depth * per_depth_ + origin_));
        }
    }
}

void AmbientOcclusionPass::take_empty(const image::Rect& area) {
    for (int y = area.y0; y < area.y1; ++y) {
        const std::size_t first = at(area.x0, y);
        std::fill_n(distance_.data() + first, area.width(), shade::SurfaceImage::kNowhere);
        std::fill_n(triangle_.data() + first, area.width(), 0U);
    }
}

void AmbientOcclusionPass::find(Jobs& jobs, const shade::AmbientOcclusion& technique) {
    using namespace shade::ambient_occlusion;
    const HorizonPattern pattern = horizon_pattern(technique);
    float* const open = open_.data() + shade::SurfaceImage::kBeside;
    float* const between = between_.data() + shade::SurfaceImage::kBeside;
    const auto in_bands = [&](auto rows) {
        jobs.for_each((surface_.height + kBand - 1) / kBand, [&](int band, int) {
            rows(band * kBand, std::min(band * kBand + kBand, surface_.height));
        });
    };
    in_bands([&](int y0, int y1) {
        find_horizons(surface_, pattern, y0, y1, open);
        blur_along_rows(surface_, y0, y1, open, between);
    });
    in_bands([&](int y0, int y1) { blur_along_columns(surface_, y0, y1, between, open); });
}

std::uint64_t AmbientOcclusionPass::bytes() const {
    return (distance_.size() + open_.size() + between_.size()) * sizeof(float) +
           triangle_.size() * sizeof(std::uint32_t) + normals_.capacity() * sizeof(Vec3);
}

} // namespace scanout::frame
