#include "shade/transparency/alpha_evaluator.h"

#include "shade/check_lanes.h"
#include "shade/setup/primitive_cache.h"

namespace scanout::shade {

using raster::kSubpixel;

AlphaEvaluator::AlphaEvaluator()
    : block_(std::make_unique<ShadingBlock>()), primitives_(std::make_unique<PrimitiveCache>()) {}
AlphaEvaluator::~AlphaEvaluator() = default;

void AlphaEvaluator::begin(const GatherInput& input, At at, std::vector<float>& out) {
    in_ = input;
    in_.frame = &input.transparency->frame;
    at_ = at;
    out_ = &out;
    out.clear();
    material_ = -2;
    primitives_->begin(in_);
    block_->lit = true;
    block_->count = block_->runs = 0;
}

void AlphaEvaluator::bind(std::int32_t index) {
    run_block();
    material_ = index;
    ShadingBlock& b = *block_;
    b.material = &in_.material(index);
    b.uv_step = in_.uv_step(index);
    const MaterialAlpha& alpha = in_.transparency->alpha[static_cast<std::size_t>(index + 1)];
    constant_ = !alpha.diffuse_map && !alpha.opacity_map;
    for (BoundMap& map : b.map)
        map = {};
    if (alpha.diffuse_map) b.map[kDiffuseMap] = bound_map(in_, kDiffuseMap, *b.material);
    if (alpha.opacity_map) b.map[kOpacityMap] = bound_map(in_, kOpacityMap, *b.material);
}

void AlphaEvaluator::add(std::uint32_t triangle, int x, int y, raster::SampleOffset sample) {
    const std::int32_t material = in_.mesh->material[triangle];
    if (material != material_) bind(material);
    out_->push_back(value_of(block_->material->opacity));
    if (!constant_) add_item(triangle, x, y, sample);
}

// What blends is there or not where its material has a cut of its own; what is cut out meets its
// cut in the pass (TransparencyPass::draw_candidates).
float AlphaEvaluator::value_of(float alpha) const {
    const auto& own_cut = block_->material->alpha_cut;
    if (at_ == At::sample || !own_cut) return alpha;
    return alpha >= *own_cut ? 1.0F : 0.0F;
}

void AlphaEvaluator::add_item(std::uint32_t triangle, int x, int y, raster::SampleOffset sample) {
    ShadingBlock& b = *block_;
    if (b.count == kBlockSize) run_block();
    if (primitives_->full()) {
        run_block();
        primitives_->clear();
    }
    const Primitive& primitive = primitives_->get(triangle);
    const auto place = at_ == At::centre ? place_in_pixel(in_, primitive, x, y, sample)
                                         : raster::SampleOffset{x * kSubpixel + sample.x,
                                                                y * kSubpixel + sample.y};
    place_[b.count] = out_->size() - 1;
    shade::add_item(b, PrimitiveCache::at(primitive, place.x, place.y), place.x, place.y);
}

void AlphaEvaluator::run_block() {
    ShadingBlock& b = *block_;
    if (b.count == 0) return;
    for (const Stage* stage : in_.transparency->stages) {
        stage->run(b, *in_.frame);
        check_lanes(b, *in_.frame, *stage);
    }
    for (int i = 0; i < b.count; ++i)
        (*out_)[place_[i]] = value_of(b.alpha[i]);
    b.count = b.runs = 0;
}

void AlphaEvaluator::finish() {
    run_block();
}

} // namespace scanout::shade
