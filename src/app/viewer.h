// The viewer without a machine: state, actions, undo and the steps of the virtual clock. It knows
// no display, no file and no time; view_session.h gives it those.
#pragma once

#include "app/actions.h"
#include "app/settings.h"
#include "geom/mesh.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

inline constexpr int kStepsPerSecond = 60;
inline constexpr int kTurntableUnitsPerStep =
    96; // 22.5 degrees a second; 960 steps are a full turn
inline constexpr int kPointerSteps = 3 * kStepsPerSecond;

// What an action asks of the session.
enum class Effect : std::uint8_t { none, load_file, reload, screenshot, frame, suspend, quit };

class Viewer {
public:
    // The picture's size, the command line's camera and model, the number of files.
    Viewer(const Settings& settings, int width, int height, int files);

    const ViewerState& state() const { return state_; }
    int width() const { return width_; } // pixels of the picture
    int height() const { return height_; }
    std::int64_t step_number() const { return step_; }

    // `mesh` is the model on show, null while there is none: then nothing can be dragged by pixels.
    Effect apply(const Action& action, const geom::Mesh* mesh);

    // How many pages the plan on the display has, one at least: X goes through them.
    void set_explain_pages(int pages) { explain_pages_ = pages; }

    // Steps of the virtual clock pass: the turntable turns, the pointer hides.
    void advance_to(std::int64_t step);
    // True when steps change something: the clock has to run. next_step(): the first that does.
    bool moving() const { return turning() || state_.pointer.visible; }
    std::int64_t next_step() const;

    // The matrices of the state; see scene::make_view for errors.
    Result<scene::View> view(const geom::Mesh& mesh) const;
    // The frame's lights where keys and mouse have put them.
    std::vector<scene::Light> lights(const geom::Mesh& mesh) const;
    void place_lights(const geom::Mesh& mesh, std::vector<scene::Light>& out) const; // the same
    // A line about the light that is selected, with short words where `letters` would be too few;
    // empty: none is.
    std::string light_line(const geom::Mesh& mesh, std::size_t letters) const;

private:
    bool turning() const { return state_.look.turntable && !drag_; }
    scene::CameraOptions camera() const;
    void remember(const Look& before);
    void undo();
    void change_look(const Action& action, const geom::Mesh* mesh);
    void begin_drag(const geom::Mesh* mesh);
    void drag(const Action& action, const geom::Mesh* mesh);
    void zoom_at(int levels, int x, int y, const geom::Mesh* mesh);
    void rotate(int right, int up, const geom::Mesh* mesh);
    void move(std::int64_t right, std::int64_t up);
    void zoom(int levels);
    bool moves_light() const { return state_.light >= 0; }
    scene::LightMove& light_move();
    void turn_light(const scene::LightMove& from, std::int64_t right, std::int64_t up,
                    const geom::Mesh* mesh);
    void brighten(int levels);
    void next_light();
    void look_from(int view);
    int clamped_elevation(std::int64_t units) const;
    std::int64_t angle_of_pixels(int pixels) const;
    Effect change_file(int by);

    scene::ModelTransform model_;
    scene::CameraOptions camera_;
    std::vector<scene::Light> lights_;
    int width_, height_, files_;
    int explain_pages_ = 1;
    Look start_; // what the command line asks for; reset comes back to it
    ViewerState state_;
    std::int64_t step_ = 0;
    std::deque<Look> history_;
    struct Drag {
        Look start;
        bool remembered = false;
        double units_per_pixel = 0;
    };
    std::optional<Drag> drag_;
};

} // namespace scanout::app
