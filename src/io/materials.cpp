#include "io/materials.h"

#include "base/mapping.h"
#include "image/codec.h"
#include "io/find_file.h"
#include "io/hidden_colours.h"
#include "io/normal_maps.h"
#include "io/obj/mtl.h"
#include "io/text.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <system_error>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace scanout::io {
namespace {

// Bounds on what one model may make us look up; no honest file comes near.
constexpr std::size_t kMaxLibraries = 256;
constexpr std::size_t kMaxTextures = 4096;
constexpr std::size_t kMaxWordsPerLibraryLine = 16;
constexpr std::string_view kMissing = "is not there";
constexpr std::string_view kOutside =
    "lies outside of the model's folder (--allow-outside reads it)";
constexpr std::size_t kTextureWarnings = 20; // told one by one, the rest together

std::string canonical(const std::string& path) {
    std::error_code error;
    const auto real = std::filesystem::canonical(path, error);
    return error ? path : real.string();
}

// The words of a mtllib statement: where each begins and ends in it. "quoted words" and words with
// "\ " inside are one.
struct Word {
    std::size_t begin, end;
};

std::vector<Word> words_of(const std::string& text) {
    std::vector<Word> words;
    for (std::size_t i = text.find_first_not_of(" \t");
         i < text.size() && words.size() < kMaxWordsPerLibraryLine;
         i = text.find_first_not_of(" \t", i)) {
        const std::size_t begin = i;
        const std::size_t quote = text[i] == '"' ? text.find('"', i + 1) : std::string::npos;
        if (quote != std::string::npos)
            i = quote + 1;
        else
            for (; i < text.size() && (text[i] != ' ' || text[i - 1] == '\\') && text[i] != '\t';
                 ++i) {
            }
        words.push_back({begin, i});
    }
    return words;
}

// The name that text[begin, end) writes down, without quotes and without backslashes before blanks.
std::string unquoted(const std::string& text, std::size_t begin, std::size_t end) {
    std::string name = text.substr(begin, end - begin);
    if (name.size() > 1 && name.front() == '"' && name.back() == '"')
        return name.substr(1, name.size() - 2);
    for (std::size_t i = name.find("\\ "); i != std::string::npos; i = name.find("\\ ", i))
        name.erase(i, 1);
    return name;
}

// The faces of each material name, -1 first.
class FacesByName {
public:
    explicit FacesByName(const ObjFile& obj) : begin_(obj.materials.size() + 2) {
        const std::vector<std::int32_t>& names = obj.polygons.face_material;
        for (const std::int32_t name : names)
            ++begin_[static_cast<std::size_t>(name + 1)];
        std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), std::size_t{0});
        face_.resize(names.size());
        std::vector<std::size_t> next = begin_;
        for (std::size_t face = 0; face < names.size(); ++face)
            face_[next[static_cast<std::size_t>(names[face] + 1)]++] =
                static_cast<std::uint32_t>(face);
    }
    std::span<const std::uint32_t> of(std::int32_t name) const {
        const auto i = static_cast<std::size_t>(name + 1);
        return std::span(face_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> face_;
};

class MaterialLoader {
public:
    MaterialLoader(const std::string& model_path, Warnings& warnings, const Reading& how)
        : model_path_(model_path), folder_(folder_of(model_path)), warnings_(warnings),
          finder_(how.allow_outside ? FileFinder() : FileFinder(folder_)),
          texture_bytes_left_(how.texture_bytes) {}

    Materials load(const std::vector<NameAtLine>& pictures) {
        for (const NameAtLine& picture : pictures) {
            scene::Material& material = out_.materials.emplace_back();
            material.map_diffuse.edit().path = picture.name;
            material.map_diffuse.edit().line = picture.line;
            material.diffuse = Vec3(1);
            load_map(material.map_diffuse, "TextureFile", model_path_);
            if (material.map_diffuse.texture() < 0) material = {};
        }
        return std::move(out_);
    }

    Materials load(const ObjFile& obj) {
        obj_ = &obj;
        read_libraries(obj.libraries, !obj.materials.empty());
        for (const NameAtLine& used : obj.materials) {
            name_ = static_cast<std::int32_t>(out_.of_name.size());
            use(used);
        }
        name_ = -1;
        use_only_material(obj);
        name_what_is_not_drawn();
        return std::move(out_);
    }

private:
    struct Library {
        std::string path;
        std::vector<MtlMaterial> materials;
        std::vector<std::string_view> not_drawn; // of the materials that are used
    };
    struct Place {
        std::size_t library, material;
    };

    void read_libraries(const std::vector<NameAtLine>& lines, bool materials_are_used);
    std::optional<std::string> own_library();
    void read_own_library(const std::string& own, std::size_t line, std::string_view why);
    void read_library(const std::string& name, std::size_t line);
    void use(const NameAtLine& used);
    void use_only_material(const ObjFile& obj);
    void add_material(Library& library, const MtlMaterial& m);
    std::int32_t opaque_texture(std::int32_t texture);
    std::int32_t filled_texture(std::int32_t texture);
    void name_what_is_not_drawn();
    void load_normal_maps(scene::Material& material, const std::string& library_path);
    bool is_normal_map(const scene::TextureMap& map);
    void load_map(scene::MaterialMap& map, std::string_view keyword,
                  const std::string& library_path);
    std::int32_t texture(const std::string& name, const std::string& where,
                         const std::string& library_path);
    std::int32_t load_texture(const std::string& path, const std::string& where);
    void texture_fault(const std::string& name, std::string line);

    const std::string& model_path_;
    std::string folder_;
    Warnings& warnings_;
    const ObjFile* obj_ = nullptr;
    std::int32_t name_ = -1;                   // whose material is loaded, in the OBJ file
    std::optional<FacesByName> faces_by_name_; // once it is asked for
    Materials out_;
    std::vector<Library> libraries_;
    std::unordered_map<std::string, Place> places_;
    FileFinder finder_;
    std::set<std::string> seen_lines_, seen_libraries_;
    bool library_missing_ = false;
    std::unordered_map<std::string, std::int32_t>
        textures_; // by folder and name, then by real path
    std::unordered_map<std::int32_t, std::int32_t> opaque_textures_, filled_textures_;
    std::unordered_map<std::int32_t, bool> holds_normals_; // of a texture, all of it
    std::uint64_t texture_bytes_left_;
    std::size_t texture_faults_ = 0;
};

void MaterialLoader::read_libraries(const std::vector<NameAtLine>& lines, bool materials_are_used) {
    for (const NameAtLine& line : lines) {
        if (!seen_lines_.insert(line.name).second) continue;
        if (seen_lines_.size() > kMaxLibraries || seen_libraries_.size() > kMaxLibraries) {
            library_missing_ = true;
            warnings_.add("libraries",
                          fmt::format("{}:{}: more than {} material libraries; the rest is ignored",
                                      model_path_, line.line, kMaxLibraries));
            return;
        }
        for (const std::string& name : library_names(finder_, folder_, line.name))
            read_library(name, line.line);
    }
    if (const auto own = own_library(); lines.empty() && materials_are_used && own)
        read_own_library(*own, 1, "names no material library");
}

// A model whose library was renamed, or is not named at all: one with the model's own name is what
// its exporter wrote.
std::optional<std::string> MaterialLoader::own_library() {
    const std::string bare = model_path_.substr(model_path_.rfind('/') + 1);
    const std::string name = bare.substr(0, bare.find('.')) + ".mtl";
    return finder_.find(folder_, name) ? std::optional(name) : std::nullopt;
}

void MaterialLoader::read_own_library(const std::string& own, std::size_t line,
                                      std::string_view why) {
    warnings_.add("own library", fmt::format("{}:{}: {}; '{}' of the model's own name is taken",
                                             model_path_, line, why, shown(own)));
    read_library(own, line);
}

// A library is read once, however often it is named; it cannot name others, so nothing can go in
// circles.
void MaterialLoader::read_library(const std::string& name, std::size_t line) {
    const auto path = finder_.find_anywhere(folder_, folder_, name);
    if (!seen_libraries_.insert(path ? canonical(*path) : name).second) return;
    if (!path) {
        const std::string why =
            fmt::format("material library '{}' {}", shown(name),
                        finder_.is_outside(folder_, name) ? kOutside : kMissing);
        if (const auto own = own_library()) return read_own_library(*own, line, why);
        library_missing_ = true;
        warnings_.add("library", fmt::format("{}:{}: {}; its materials are drawn plain",
                                             model_path_, line, why));
        return;
    }
    const auto file = Mapping::open(*path);
    if (!file || not_a_text_model(file->text())) {
        library_missing_ = true;
        warnings_.add("library",
                      fmt::format("{}:{}: {}; its materials are drawn plain", model_path_, line,
                                  file ? *path + ": is no material library" : file.error().what));
        return;
    }
    Library& library = libraries_.emplace_back();
    library.path = *path;
    library.materials = read_mtl(file->text(), *path, warnings_);
    out_.bytes += file->size();
    out_.libraries.push_back(*path);
    if (library.materials.empty())
        warnings_.add("empty library", fmt::format("{}: holds no material", *path));
    for (std::size_t i = 0; i < library.materials.size(); ++i) {
        const MtlMaterial& m = library.materials[i];
        if (!places_.try_emplace(m.material.name, Place{libraries_.size() - 1, i}).second)
            warnings_.add("material twice",
                          fmt::format("{}:{}: material '{}' is defined already; the first "
                                      "definition is used",
                                      *path, m.line, shown(m.material.name)));
    }
}

void MaterialLoader::use(const NameAtLine& used) {
    const auto found = places_.find(used.name);
    if (found == places_.end()) {
        out_.of_name.push_back(-1);
        if (!library_missing_) // else it is told already
            warnings_.add("material",
                          fmt::format("{}:{}: material '{}' is not defined; drawn plain",
                                      model_path_, used.line, shown(used.name)));
        return;
    }
    Library& library = libraries_[found->second.library];
    out_.of_name.push_back(static_cast<std::int32_t>(out_.materials.size()));
    add_material(library, library.materials[found->second.material]);
}

// A library of one material and a model that uses none: its exporter left the line out.
void MaterialLoader::use_only_material(const ObjFile& obj) {
    if (!obj.materials.empty() || libraries_.size() != 1 || libraries_[0].materials.size() != 1)
        return;
    warnings_.add(
        "only material",
        fmt::format("{}: uses no material (usemtl): the only one of its library, '{}', is "
                    "taken",
                    model_path_, shown(libraries_[0].materials[0].material.name)));
    out_.of_rest = 0;
    add_material(libraries_[0], libraries_[0].materials[0]);
}

void MaterialLoader::add_material(Library& library, const MtlMaterial& m) {
    for (const std::string_view what : m.not_drawn)
        if (std::find(library.not_drawn.begin(), library.not_drawn.end(), what) ==
            library.not_drawn.end())
            library.not_drawn.push_back(what);
    scene::Material& material = out_.materials.emplace_back(m.material);
    // The other maps stay names until something draws them: what is not used costs nothing.
    load_map(material.map_opacity, "map_d", library.path);
    if (material.map_opacity.texture() >= 0 && material.map_opacity->channel == 0) {
        // Its channel is not given: alpha, where the file has an alpha channel that says something.
        const auto& t = out_.textures[static_cast<std::size_t>(material.map_opacity->texture)];
        const auto pixels = t.image.pixels();
        const bool alpha = std::any_of(pixels.begin(), pixels.end(),
                                       [](const image::Rgba8& p) { return p.a != 255; });
        material.map_opacity.edit().channel = alpha ? 'm' : 'l';
    }
    load_map(material.map_diffuse, "map_Kd", library.path);
    // Kd 0 0 0 beside a map is an exporter's "see the map" (Maya's); without the map it would be a
    // hole.
    if (material.map_diffuse.given() && material.diffuse == Vec3(0)) {
        const bool drawn = material.map_diffuse.texture() >= 0;
        material.diffuse = drawn ? Vec3(1) : scene::Material().diffuse;
        if (drawn)
            warnings_.add(
                "Kd 0 with map",
                fmt::format("{}:{}: Kd is 0 beside map_Kd and would hide it; it counts as 1",
                            library.path, m.line));
    }
    // The alpha of map_Kd says how opaque it is where no other map does.
    if (material.map_diffuse.texture() >= 0)
        material.map_diffuse.edit().texture = material.map_opacity.texture() >= 0
                                                  ? opaque_texture(material.map_diffuse->texture)
                                                  : filled_texture(material.map_diffuse->texture);
    load_normal_maps(material, library.path);
    if (has_highlight(material)) {
        load_map(material.map_specular, "map_Ks", library.path);
        load_map(material.map_shininess, "map_Ns", library.path);
    }
    if (material.emission != Vec3(0)) load_map(material.map_emission, "map_Ke", library.path);
    if (surface_of(material) == scene::Surface::physical) {
        if (roughness_of(material) > 0) load_map(material.map_roughness, "map_Pr", library.path);
        if (metalness_of(material) > 0) load_map(material.map_metalness, "map_Pm", library.path);
    }
    // What only the map gives is gone with it.
    if (m.roughness_by_map && material.map_roughness.texture() < 0) material.roughness.reset();
    if (m.metalness_by_map && material.map_metalness.texture() < 0) material.metalness.reset();
    if (m.specular_by_map && material.map_specular.texture() < 0) material.specular = Vec3(0);
    if (m.emission_by_map && material.map_emission.texture() < 0) material.emission = Vec3(0);
}

// The texture without its alpha channel: itself where that says nothing.
std::int32_t MaterialLoader::opaque_texture(std::int32_t texture) {
    const auto [known, is_new] = opaque_textures_.try_emplace(texture, texture);
    if (!is_new) return known->second;
    const scene::Texture& given = out_.textures[static_cast<std::size_t>(texture)];
    const auto is_opaque = [](const image::Rgba8& p) { return p.a == 255; };
    const auto pixels = given.image.pixels();
    if (std::all_of(pixels.begin(), pixels.end(), is_opaque)) return texture;
    scene::Texture opaque = given;
    for (image::Rgba8& p : opaque.image.pixels())
        p.a = 255;
    out_.textures.push_back(std::move(opaque));
    return known->second = static_cast<std::int32_t>(out_.textures.size()) - 1;
}

// The texture without the colours that its alpha hides: itself where it hides none. A copy: in
// other maps the same file's alpha may hide nothing.
std::int32_t MaterialLoader::filled_texture(std::int32_t texture) {
    const auto [known, is_new] = filled_textures_.try_emplace(texture, texture);
    if (!is_new) return known->second;
    scene::Texture filled = out_.textures[static_cast<std::size_t>(texture)];
    if (!fill_hidden_colours(filled.image)) return texture;
    out_.textures.push_back(std::move(filled));
    return known->second = static_cast<std::int32_t>(out_.textures.size()) - 1;
}

void MaterialLoader::load_normal_maps(scene::Material& material, const std::string& library_path) {
    load_map(material.map_normal, "norm", library_path);
    if (material.map_bump.given() && material.map_bump->bump_multiplier != 0)
        load_map(material.map_bump, "map_bump", library_path);
    if (material.map_bump.texture() >= 0 && !material.map_normal.given() &&
        is_normal_map(material.map_bump))
        std::swap(material.map_bump, material.map_normal);
}

bool MaterialLoader::is_normal_map(const scene::TextureMap& map) {
    const image::Image& image = out_.textures[static_cast<std::size_t>(map.texture)].image;
    const auto [known, is_new] = holds_normals_.try_emplace(map.texture, false);
    if (is_new) known->second = holds_normals(image);
    if (known->second) return true;
    if (!faces_by_name_) faces_by_name_.emplace(*obj_);
    return shows_normals(image, map, obj_->polygons, faces_by_name_->of(name_));
}

void MaterialLoader::name_what_is_not_drawn() {
    for (const Library& library : libraries_)
        if (!library.not_drawn.empty())
            warnings_.add(library.path + " not drawn",
                          fmt::format("{}: {} {} read but not drawn yet", library.path,
                                      fmt::join(library.not_drawn, ", "),
                                      library.not_drawn.size() == 1 ? "is" : "are"));
}

void MaterialLoader::load_map(scene::MaterialMap& map, std::string_view keyword,
                              const std::string& library_path) {
    if (!map.given()) return;
    scene::TextureMap& read = map.edit();
    read.texture = texture(read.path, fmt::format("{}:{}: {}", library_path, read.line, keyword),
                           library_path);
    read.missing = read.texture < 0;
}

// where: file:line: keyword.
std::int32_t MaterialLoader::texture(const std::string& name, const std::string& where,
                                     const std::string& library_path) {
    const std::string folder = folder_of(library_path);
    const auto [known, is_new] = textures_.try_emplace(folder + '\n' + name, -1);
    if (!is_new) return known->second;
    if (textures_.size() > 2 * kMaxTextures) {
        warnings_.add("textures", fmt::format("{}: more than {} textures; the rest is drawn plain",
                                              where, kMaxTextures));
        return -1;
    }
    const auto path = finder_.find_anywhere(folder, folder_, name);
    if (!path) {
        texture_fault(name, fmt::format("{}: '{}' {}; drawn plain", where, shown(name),
                                        finder_.is_outside(folder, name) ? kOutside : kMissing));
        return -1;
    }
    const std::string real = canonical(*path);
    const auto [loaded, first] = textures_.try_emplace(real, -1);
    if (first) loaded->second = load_texture(*path, where);
    return textures_[folder + '\n' + name] = textures_[real];
}

std::int32_t MaterialLoader::load_texture(const std::string& path, const std::string& where) {
    image::DecodeLimits limits;
    limits.max_pixels = std::min(
        limits.max_pixels, static_cast<std::int64_t>(texture_bytes_left_ / sizeof(image::Rgba8)));
    auto picture = image::load(path, limits);
    if (!picture) {
        texture_fault(path, fmt::format("{}: {}; drawn plain", where, picture.error().what));
        return -1;
    }
    if (paint_clear_alpha(*picture))
        warnings_.add(
            "alpha zero",
            fmt::format("{}: '{}' has an alpha channel of 0 everywhere; it is drawn opaque", where,
                        shown(path)));
    const std::uint64_t bytes = picture->pixels().size_bytes();
    texture_bytes_left_ -= bytes;
    out_.bytes += bytes;
    out_.textures.push_back({path, *std::move(picture)});
    return static_cast<std::int32_t>(out_.textures.size()) - 1;
}

void MaterialLoader::texture_fault(const std::string& name, std::string line) {
    const bool alone = ++texture_faults_ <= kTextureWarnings;
    warnings_.add(alone ? "texture " + name : "more textures", std::move(line));
}

} // namespace

std::vector<std::string> library_names(FileFinder& finder, const std::string& folder,
                                       const std::string& text) {
    if (finder.find(folder, text)) return {text};
    const std::vector<Word> words = words_of(text);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < words.size();) {
        const auto name = [&](std::size_t last) {
            return unquoted(text, words[i].begin, words[last].end);
        };
        std::size_t last = words.size() - 1;
        while (last > i && !finder.find(folder, name(last)))
            --last;
        if (last == i &&
            !finder.find(folder, name(i))) // none is there: the name ends with its extension
            for (std::size_t k = i; k < words.size(); ++k)
                if (lower_case(name(k)).ends_with(".mtl")) {
                    last = k;
                    break;
                }
        names.push_back(name(last));
        i = last + 1;
    }
    return names;
}

Materials load_materials(const ObjFile& obj, const std::string& obj_path, Warnings& warnings,
                         const Reading& how) {
    return MaterialLoader(obj_path, warnings, how).load(obj);
}

Materials load_texture_materials(const std::vector<NameAtLine>& pictures,
                                 const std::string& model_path, Warnings& warnings,
                                 const Reading& how) {
    return MaterialLoader(model_path, warnings, how).load(pictures);
}

} // namespace scanout::io
