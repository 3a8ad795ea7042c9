// The viewer without a machine: state, actions, undo and the steps of the virtual clock. It knows
// no display, no file and no time; view_session.h gives it those.
#pragma once

#include "app/moving/moment.h"
#include "app/options/settings.h"
#include "app/view/actions.h"
#include "app/view/pixel_place.h"
#include "geom/mesh.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scanout::app {

inline constexpr int kStepsPerSecond = 60;
inline constexpr int kTurntableUnitsPerStep =
    96; // 22.5 degrees a second; 960 steps are a full turn
inline constexpr int kPointerSteps = 3 * kStepsPerSecond;

// What an action asks of the session.
enum class Effect : std::uint8_t {
    none,
    load_file,
    reload,
    screenshot,
    print_view,
    pick,
    rendering, // a switch of it: the plan says what comes of it
    rung_down,
    rung_up,
    frame,
    suspend,
    quit
};

// A place to look at, and the normal of the surface there; file coordinates.
struct HazardSpot {
    DVec3 at{0}, normal{0}; // normal: of any length; 0 where there is none
};

class Viewer {
public:
    // The picture's size, the command line's camera and model, the number of files.
    Viewer(const Settings& settings, int width, int height, int files);

    const ViewerState& state() const { return state_; }
    int width() const { return width_; } // pixels of the picture
    int height() const { return height_; }
    void resize(int width, int height); // the model fits anew
    std::int64_t step_number() const { return step_; }

    // `mesh` is the model on show, null while there is none: then nothing can be dragged by pixels.
    Effect apply(const Action& action, const geom::Mesh* mesh);
    // What the last action has to say for a moment: the new state of what it switched, or why
    // nothing happened. Empty: the picture says it.
    const std::string& answer() const { return answer_; }

    // The axis that a file that is shown from now on has upwards; the user's own choice stays.
    void take_up_of_file(scene::UpAxis up);

    // Another file is on show, or, `again`, the same one after a change: it fits anew, turned as
    // the one before. To be called before view() sees its mesh.
    void take_file(bool again);

    // How many pages the help sheet, the plan and the file's warnings have on the display, one at
    // least: their keys go through them.
    struct Pages {
        int help = 1, explain = 1, warnings = 1;
    };
    void set_pages(const Pages& pages) { pages_ = pages; }

    // A point that was picked: after the third one the next begins anew.
    void take_point(const DVec3& file_coordinates);
    std::span<const DVec3> measured() const {
        return {state_.measured.data(), static_cast<std::size_t>(state_.measured_count)};
    }

    // Where the hazards of the model are, in the order of the panel: D goes through them.
    void set_hazards(std::vector<std::optional<HazardSpot>> places);
    // The place of the hazard that is selected, and its pixel; nothing where there is none.
    std::optional<DVec3> hazard_place() const;
    std::optional<PixelPlace> pixel_of(const DVec3& place, const geom::Mesh& mesh) const;

    // The moment of a motion that is shown, in seconds; nothing without --motion.
    std::optional<double> motion_time() const;
    // Steps of the virtual clock pass: motion and turntable go on, the pointer hides.
    void advance_to(std::int64_t step);
    // True when steps change something: the clock has to run. next_step(): the first that does.
    bool turning() const { return turntable_turns() || spins() || state_.look.plays; }
    bool moving() const { return turning() || follows_hand() || state_.pointer.visible; }
    std::int64_t next_step() const;

    // The matrices of the state; see scene::make_view for errors.
    Result<scene::View> view(const geom::Mesh& mesh) const;
    double fov_degrees(const geom::Mesh& mesh) const { return moment(mesh).camera.fov_degrees; }
    // The frame's lights where keys and mouse have put them.
    std::vector<scene::Light> lights(const geom::Mesh& mesh) const;
    void place_lights(const geom::Mesh& mesh, std::vector<scene::Light>& out) const; // the same
    // A line about the light that is selected, with short words where `letters` would be too few;
    // empty: none is.
    std::string light_line(const geom::Mesh& mesh, std::size_t letters) const;

private:
    bool turntable_turns() const { return state_.look.turntable && !drag_; }
    // Inertia (drive/viewer_inertia.cpp).
    bool spins() const { return spin_.right != 0 || spin_.up != 0; }
    void follow_turn(std::int64_t right, std::int64_t up); // of the drag, since its start
    // A hand turns something that it may throw: the clock has to run to see how fast.
    bool follows_hand() const;
    void throw_off(); // the button goes up
    void stop_spin(ActionId id);
    void rest_if_slow();
    void spin();
    // A motion (moving/viewer_motion.cpp).
    const scene::Motion* motion() const; // that moves what is seen; null: none
    Moment moment(const geom::Mesh& mesh) const;
    void toggle_playing();
    void play(std::int64_t steps);
    Effect carry_out(const Action& action, const geom::Mesh* mesh);
    Effect close_topmost(const geom::Mesh* mesh); // Esc
    scene::CameraOptions camera() const;          // before the model is fitted
    const scene::CameraOptions& fitted_camera(const geom::Mesh& mesh) const;
    static std::int64_t moved(std::int64_t pan, double by_units);
    void remember(const Look& before);
    void undo();
    void put_split(std::int64_t x);
    bool switch_rendering(ActionId id);
    // The flight (viewer_flight.cpp). True where the action is one of the camera that flies.
    bool fly(const Action& action, const geom::Mesh* mesh);
    void toggle_fly();
    void fly_by(const DVec3& units, const geom::Mesh& mesh);
    void look_by(std::int64_t left, std::int64_t up, const scene::Flight& from,
                 const geom::Mesh& mesh);
    void drag_flight(const Action& action, const geom::Mesh& mesh);
    Result<scene::View> view_from_orbit(const geom::Mesh& mesh) const;
    scene::ModelTransform model() const; // with the stretch of the keys
    void move_in_depth(std::int64_t near);
    void scale(int levels);
    void change_look(const Action& action, const geom::Mesh* mesh);
    void begin_drag(const geom::Mesh* mesh);
    void drag(const Action& action, const geom::Mesh* mesh);
    void remember_drag();
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
    void stop_measuring();
    void next_section();
    void flip_section();
    void slide_section(int levels, const geom::Mesh* mesh);
    void toggle(frame::Annotation annotation, const geom::Mesh* mesh);
    void next_hazard(const geom::Mesh* mesh);
    void fly_to(const HazardSpot& spot, const geom::Mesh& mesh);
    void fit(const geom::Mesh* mesh);
    bool fit_once(const geom::Mesh& mesh);
    bool fits(const geom::Mesh& mesh) const;
    void zoom_model(int levels);
    int clamped_elevation(std::int64_t units) const;
    // The split line moves by this much, and is taken by a pointer no farther away than that.
    int split_step() const { return std::max(1, width_ / 64); }
    std::int64_t angle_of_pixels(int pixels) const;
    Effect change_file(int by);

    scene::ModelTransform model_;
    scene::CameraOptions camera_;
    std::vector<scene::Light> lights_;
    std::optional<scene::Motion> motion_;   // --motion
    std::optional<scene::Motion> of_model_; // its tracks but the camera's
    double motion_start_ = 0;               // --time, seconds
    int width_, height_, files_;
    Pages pages_;
    std::vector<std::optional<HazardSpot>> hazards_;
    Look start_; // what the command line asks for; reset comes back to it
    ViewerState state_;
    std::int64_t step_ = 0;
    std::string answer_;
    std::int64_t turned_ = 0; // by the turntable, angle units, since the start
    struct Remembered {
        Look look;
        std::int64_t turned;
    };
    std::deque<Remembered> history_;
    struct Turn {
        std::int64_t step = 0, right = 0, up = 0; // angle units
    };
    bool inertia_;
    struct Spin {
        bool camera = false;            // else the model
        std::int64_t right = 0, up = 0; // parts of an angle unit a step
        std::int64_t rest_right = 0, rest_up = 0;
    };
    Spin spin_;
    struct Drag {
        Look start;
        bool remembered = false;
        std::optional<int> split_x; // the split line is what is dragged
        double units_per_pixel = 0;
        bool turns = false; // model or camera
        Turn earlier{}, last{};
        int farthest = 0; // from where it began, pixels
    };
    std::optional<Drag> drag_;
    // Where the camera stands for the present file to fit, by what that depends on: found once.
    struct FitKey {
        int view;
        scene::Projection projection;
        scene::UpAxis up;
        friend bool operator==(const FitKey&, const FitKey&) = default;
    };
    struct Fit {
        FitKey key;
        scene::CameraOptions camera;
    };
    mutable std::vector<Fit> fits_;
};

} // namespace scanout::app
