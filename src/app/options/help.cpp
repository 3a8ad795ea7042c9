#include "app/options/help.h"

#include "app/options/options.h"
#include "app/options/text.h"
#include "frame/catalogue.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::string_view kOverview =
    "scanout - 3D models on the Linux console, drawn by the CPU alone\n"
    "\n"
    "  scanout models/spot/spot.obj                  show a model; arrows turn it, H helps, Q "
    "quits\n"
    "  scanout render models/spot/spot.obj -o s.png  draw a picture, without a display\n"
    "  scanout explain models/spot/spot.obj          what runs for it, why, and at what price\n"
    "  scanout frontier models/spot/spot.obj         what accuracy costs in time\n"
    "  scanout doctor models/spot/spot.obj           what in the file may spoil the picture\n"
    "  scanout info models/spot/spot.obj             what is in the file, and its size\n"
    "  scanout compare got.png expected.png          are two pictures the same?\n"
    "\n"
    "Commands:\n"
    "  view MODEL...      show models on the display (also without the word view)\n"
    "  render MODEL       draw to PNG, PPM or PAM files or to standard output\n"
    "  explain MODEL      each effect: on or off, why, its time, its memory, the error without it\n"
    "  frontier MODEL     error and time of every way to draw it, and the best ways there are\n"
    "  doctor MODEL       cracks, overlaps, bad normals and more: how many, where, in how many "
    "pixels\n"
    "  info MODEL         counts, size, surface, materials, textures found and missing\n"
    "  compare A B        compare two pictures, with two numbers as tolerance\n"
    "  spectrum PICTURE   its Fourier transform as a picture, or the picture of a band of it\n"
    "  colour VALUE       a colour in every model, or a picture's channels in one (--channels)\n"
    "  synthesise SAMPLE  a texture of any size that looks like the sample\n"
    "  list WHAT          displays connectors modes techniques formats targets keys options "
    "renderers\n"
    "  restore            the console on the screen back to text, after a program that died\n"
    "  generate WHAT      a zone plate, terrain, fractals, as pictures or models; the manual "
    "page,\n"
    "                     completions: man bash zsh fish\n"
    "\n"
    "  scanout COMMAND --help explains a command, --help-all all its options; scanout --version\n"
    "  prints the version. Options for every run: ~/.config/scanout/options, SCANOUT_OPTIONS.\n"
    "\n"
    "Exit codes: 0 ok, 2 usage, 3 file unreadable or unsupported, 4 hazards found (--strict),\n"
    "nothing drawn (--fail-if-empty), 5 no display or no permission, 21 sizes differ, 22 pixels\n"
    "differ, 70 internal.\n";

// Those of --help; the others stand in --help-all.
constexpr auto kEveryday = std::to_array<std::string_view>(
    {"output",  "format",     "hash",      "json",     "csv",       "html",       "size",
     "samples", "background", "shading",   "texture",  "shadow",    "light",      "view",
     "camera",  "up",         "turntable", "budget",   "reference", "projection", "backend",
     "device",  "mode",       "converge",  "replay",   "axis",      "seconds",    "quick",
     "strict",  "fix",        "sarif",     "metric",   "max-diff",  "max-pixels", "verbose",
     "quiet",   "heatmap",    "keep",      "channels", "by",        "window",     "seed",
     "detail"});

} // namespace

std::string_view introduction(Command command) {
    switch (command) {
    case Command::view:
        return "scanout [view] MODEL... - show models on the console's display\n"
               "\n"
               "  scanout models/spot/spot.obj                the first display that opens\n"
               "  scanout models/*/*.obj                      PgDn and PgUp go through them\n"
               "  scanout view spot.obj --view iso --up z     start from another side\n"
               "  scanout view spot.obj --budget 16ms         as well as 16 ms a frame allow\n"
               "  scanout view spot.obj --backend terminal    by ssh, in the terminal\n"
               "  scanout view spot.obj --backend headless --size 640x480 --replay actions.txt\n"
               "\n"
               "Arrows or left drag turn the model, Shift moves it, the wheel scales it, H shows "
               "all\n"
               "keys (`scanout list keys`), Q quits.\n";
    case Command::render:
        return "scanout render MODEL -o FILE - draw a model to a file\n"
               "\n"
               "  scanout render spot.obj -o spot.png --size 1920x1080 --samples 8\n"
               "  scanout render spot.obj -o - --format ppm | display -\n"
               "  scanout render spot.obj -o turn-{n}.png --turntable 36 --view iso\n"
               "  scanout render spot.obj -o spot.png --budget 16ms     as well as 16 ms allow\n"
               "  scanout render spot.obj -o spot.png --max-error 1     as quick as a code allows\n"
               "  scanout render spot.obj --hash                        the picture's hash\n"
               "  scanout render spot.obj -o spot.png --json            times and counts\n";
    case Command::explain:
        return "scanout explain MODEL - the plan of a frame: each effect, and why it runs or not\n"
               "\n"
               "  scanout explain spot.obj\n"
               "  scanout explain spot.obj --camera 150,20 --samples 4   of this frame\n"
               "  scanout explain spot.obj --no-times                    without milliseconds\n"
               "  scanout explain spot.obj --json=plan.json\n"
               "\n"
               "ms: a frame with the effect minus one without. codes, FLIP, pixels: what differs "
               "when "
               "it\n"
               "is switched the other way.\n";
    case Command::frontier:
        return "scanout frontier MODEL - what accuracy costs in time, on this model and machine\n"
               "\n"
               "  scanout frontier spot.obj --camera 150,20 --size 640x360\n"
               "  scanout frontier spot.obj --quick --axis aa --axis texture\n"
               "  scanout frontier spot.obj --json=f.json --csv f.csv --html f.html\n"
               "  scanout frontier spot.obj --svg f.svg --png f.png --sheet sheet.png\n"
               "  scanout frontier spot.obj --no-times          errors alone\n"
               "\n"
               "Every rung of every axis is drawn, compared with a reference picture and timed; "
               "then\n"
               "whole configurations. Ctrl-C ends the measurement and keeps what there is.\n";
    case Command::doctor:
        return "scanout doctor MODEL - what in a model's file may spoil its picture\n"
               "\n"
               "  scanout doctor spot.obj                            a line a hazard, or one that "
               "all is well\n"
               "  scanout doctor spot.obj --camera 150,20 --size 640x360   pixels of this view\n"
               "  scanout doctor spot.obj --fix mended.obj           mend what needs no guess\n"
               "  scanout doctor spot.obj --strict --sarif out.sarif     in a CI job\n"
               "\n"
               "Each line: severity, hazard, how many, the worst one and its place in the file, "
               "how "
               "many\n"
               "pixels show it here and in the worst of 26 views around the model, and advice. A "
               "warning\n"
               "means that a picture is not that of the surface meant; a note is worth knowing.\n";
    case Command::info:
        return "scanout info MODEL - what a model's file holds\n"
               "\n"
               "  scanout info spot.obj\n"
               "  scanout info spot.obj --json=spot.json\n"
               "\n"
               "Lengths, area and volume are in the file's units. What may spoil a picture is "
               "`scanout\n"
               "doctor`'s matter.\n";
    case Command::compare:
        return "scanout compare A B - compare the picture A (got) with the picture B (expected)\n"
               "\n"
               "  scanout compare got.png expected.png\n"
               "  scanout compare got.png expected.png --max-diff 2 --max-pixels 100\n"
               "  scanout compare got.png expected.png --metric psnr --limit 40\n"
               "  scanout compare got.png expected.png --metric flip --heatmap error.png\n"
               "\n"
               "Exit code 0: the same within the tolerance; 21: sizes differ; 22: pixels differ.\n"
               "Where they differ it writes got, expected and difference as PNG.\n";
    case Command::spectrum:
        return "scanout spectrum PICTURE -o FILE - the waves that a picture is the sum of\n"
               "\n"
               "  scanout spectrum photo.png -o spectrum.png\n"
               "  scanout spectrum photo.png -o blurred.png --keep ..0.25\n"
               "  scanout spectrum photo.png -o edges.png --keep 0.25..\n"
               "\n"
               "The two-dimensional Fourier transform of its luminance: zero frequency in the "
               "middle,\n"
               "grey the logarithm of a wave's strength. With --keep all other frequencies are "
               "dropped,\n"
               "and the picture is written back.\n";
    case Command::colour:
        return "scanout colour VALUE - one colour in every model of colour\n"
               "\n"
               "  scanout colour '#ff8000'\n"
               "  scanout colour hsv:30,1,1\n"
               "  scanout colour lab:67,43,74\n"
               "  scanout colour photo.png --channels lab -o lab.png      L, a and b beside each "
               "other\n"
               "  scanout colour photo.png --channels ycbcr -o 'c-{n}.png'\n"
               "\n"
               "MODEL:A,B,C with rgb linear cmy hsv hsl ycbcr xyz lab, #rrggbb, or a name; each "
               "line of\n"
               "the answer can be asked for again.\n";
    case Command::synthesise:
        return "scanout synthesise SAMPLE -o FILE - more of a texture than there is\n"
               "\n"
               "  scanout synthesise bark.png -o more.png --size 512x512\n"
               "  scanout synthesise bark.png -o other.png --seed 7 --window 48\n"
               "  scanout synthesise sand.png -o sand-2.png --by pixel --size 128x128\n"
               "\n"
               "No pixel is new: patches, or pixels, of the sample are laid where they fit best "
               "what is\n"
               "there. The same sample, options and seed give the same bits.\n";
    case Command::generate:
        return "scanout generate WHAT - pictures and models by a formula; what a system installs\n"
               "\n"
               "  scanout generate zone_plate -o zone_plate.obj    what shows aliasing: also "
               "checker\n"
               "  scanout generate terrain -o hills.obj --size 1025x513 --seed 7\n"
               "  scanout generate mandelbrot -o m.png --size 1920x1080 --detail 1000\n"
               "  scanout generate koch -o koch.png                also fern, sierpinski, dragon\n"
               "  scanout generate man > scanout.1                 the manual page\n"
               "  source <(scanout generate bash)                  completions in this bash\n"
               "  scanout generate zsh > ~/.zfunc/_scanout         where fpath has ~/.zfunc\n"
               "  scanout generate fish > ~/.config/fish/completions/scanout.fish\n"
               "\n"
               "Every formula gives a picture, a texture, or, where the name ends in .obj, a "
               "model, "
               "of any\n"
               "size; the same numbers give the same bits.\n";
    case Command::restore:
        return "scanout restore - a text console again, after a program that died on it\n"
               "\n"
               "  sudo scanout restore       from another machine (ssh), where the keyboard is "
               "dead\n"
               "\n"
               "The console on the screen goes back to text mode, its keyboard on and its terminal "
               "to\n"
               "lines with echo. Where a program that lives draws (DRM master, or scanout) it is "
               "left "
               "alone. "
               "After\n"
               "scanout itself this is needed only where its guard (console-guard) was killed "
               "first.\n";
    case Command::list:
        break;
    }
    return "scanout list WHAT - what there is on this machine and in this program\n"
           "\n"
           "  scanout list displays      displays that can be opened, and why others can not\n"
           "  scanout list connectors    connectors of the graphics cards\n"
           "  scanout list modes         modes of the connectors\n"
           "  scanout list techniques    how a picture can be drawn; with an axis, its rungs\n"
           "  scanout list formats       files that can be read, pixel formats of displays\n"
           "  scanout list targets       instruction sets\n"
           "  scanout list keys          keys of the viewer\n"
           "  scanout list options       all options, as a table\n"
           "  scanout list renderers     textbook renderers and their parts\n";
}

namespace {

// `text` in lines of at most `width` letters, each but the first indented.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
    std::string lines;
    while (text.size() > width) {
        const std::size_t space = text.rfind(' ', width);
        if (space == std::string_view::npos) break;
        lines += fmt::format("{}\n{:{}}", text.substr(0, space), "", indent);
        text.remove_prefix(space + 1);
    }
    return lines + std::string(text);
}

std::string described(const Option& option, std::string_view help) {
    const std::string value = value_text(option);
    const std::string shown = value.empty()           ? ""
                              : option.optional_value ? "[=" + value + "]"
                                                      : " " + value;
    const std::string name =
        fmt::format("  {}--{}{}", option.letter != 0 ? fmt::format("-{}, ", option.letter) : "    ",
                    option.name, shown);
    constexpr std::size_t kColumn = 32;
    const bool fits = name.size() < kColumn;
    return fmt::format("{:<{}}{}{}\n", name, kColumn,
                       fits ? "" : fmt::format("\n{:{}}", "", kColumn),
                       wrapped(help, 100 - kColumn, kColumn));
}

std::string short_help_of(const Option& option) {
    std::string help(option.help);
    if (!option.default_text.empty()) help += fmt::format(" [{}]", option.default_text);
    return help;
}

// In the order of groups, and in the table's within each.
std::vector<const Option*> options_of(Command command) {
    std::vector<const Option*> found;
    for (const Option& option : options())
        if (belongs(option, command)) found.push_back(&option);
    std::stable_sort(found.begin(), found.end(),
                     [](const Option* a, const Option* b) { return a->group < b->group; });
    return found;
}

bool is_everyday(const Option* option) {
    return std::count(kEveryday.begin(), kEveryday.end(), option->name) > 0;
}

} // namespace

std::string help_overview() {
    return std::string(kOverview);
}

std::string help_of(const Option& option) {
    std::string help = short_help_of(option);
    if (!std::holds_alternative<Asked>(option.slot)) return help;
    std::string axis(option.name);
    std::replace(axis.begin(), axis.end(), '-', '_');
    constexpr std::string_view kWhere = " (`list techniques`)";
    if (const std::size_t at = help.find(kWhere); at != std::string::npos)
        help.erase(at, kWhere.size());
    return fmt::format("{}: auto {}", help, fmt::join(frame::names_on(axis), " "));
}

static std::string help_with(Command command, const std::vector<const Option*>& shown,
                             std::string (*describe)(const Option&)) {
    std::string text(introduction(command));
    const Option* last = nullptr;
    for (const Option* option : shown) {
        if (last == nullptr || last->group != option->group)
            text += fmt::format("\n{}:\n", title_of(option->group));
        text += described(*option, describe(*option));
        last = option;
    }
    return text + "  -h, --help                    this text\n";
}

std::string help_for(Command command) {
    std::vector<const Option*> all = options_of(command), shown;
    std::copy_if(all.begin(), all.end(), std::back_inserter(shown), is_everyday);
    const std::string text = help_with(command, shown, short_help_of);
    return fmt::format("{}      --help-all                {}\n", text,
                       all.size() > shown.size()
                           ? fmt::format("{} options more", all.size() - shown.size())
                           : "the same");
}

std::string full_help_for(Command command) {
    return help_with(command, options_of(command), help_of) +
           "      --                        files alone follow, also those that begin with -\n";
}

} // namespace scanout::app
