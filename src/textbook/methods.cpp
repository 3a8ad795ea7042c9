#include "textbook/methods.h"

namespace scanout::textbook {
namespace {

#define TEXTBOOK_METHOD(name, blurb) Method{#name, blurb},
#define TEXTBOOK_METHODS(part, Type, METHODS, help)                                                \
    constexpr std::array k##Type##Methods = {METHODS(TEXTBOOK_METHOD)};
TEXTBOOK_PARTS(TEXTBOOK_METHODS)
constexpr std::array kRendererNames = {TEXTBOOK_RENDERER(TEXTBOOK_METHOD)};
#define TEXTBOOK_PART(part, Type, METHODS, help) Part{#part, help, k##Type##Methods},
constexpr std::array kPartRows = {TEXTBOOK_PARTS(TEXTBOOK_PART)};
#undef TEXTBOOK_METHOD
#undef TEXTBOOK_METHODS
#undef TEXTBOOK_PART

// The documents' systems as they stand.
Parts own_parts(Renderer renderer) {
    Parts own;
    switch (renderer) {
    case Renderer::textbook:
        break;
    case Renderer::compendium:
        own.line = Line::dda;
        own.fill = Fill::flat_halves;
        own.interpolation = Interpolation::spans_perspective;
        own.conventions = {-1, true, true};
        break;
    case Renderer::course: // it interpolates nothing: its faces have one light each
        own.line = Line::dda;
        own.fill = Fill::flat_halves;
        own.interpolation = Interpolation::affine;
        own.hidden = Hidden::painters;
        own.clip = Clip::four_cases;
        own.conventions = {0, false, false};
        break;
    case Renderer::software_graphics: // "the depth test is not built yet"
        own.hidden = Hidden::drawing_order;
        break;
    }
    return own;
}

} // namespace

std::span<const Part> parts() {
    return kPartRows;
}

std::span<const Method> renderers() {
    return kRendererNames;
}

Parts parts_of(Renderer renderer, const AskedParts& asked) {
    Parts all = own_parts(renderer);
    all.line = asked.line.value_or(all.line);
    all.fill = asked.fill.value_or(all.fill);
    all.interpolation = asked.interpolation.value_or(all.interpolation);
    all.hidden = asked.hidden.value_or(all.hidden);
    all.clip = asked.clip.value_or(all.clip);
    all.line_clip = asked.line_clip.value_or(all.line_clip);
    return all;
}

} // namespace scanout::textbook
