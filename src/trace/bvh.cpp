#include "trace/bvh.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <embree3/rtcore.h>

namespace scanout::trace {
namespace {

// Of the radius of all that there is, from where the ray of single precision and its way to a box
// may be off: some 7 roundings of 2^-24.
constexpr double kSlack = 0x1p-19;

float rounded_down(double x) {
    const auto f = static_cast<float>(x);
    return double{f} > x ? std::nextafter(f, -INFINITY) : f;
}
float rounded_up(double x) {
    const auto f = static_cast<float>(x);
    return double{f} < x ? std::nextafter(f, INFINITY) : f;
}

} // namespace

struct Bvh::State {
    std::vector<Corners> triangles;
    DVec3 middle{0};
    double radius = 0x1p-60;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    double slack() const { return radius * kSlack; }
    ~State() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

namespace {

// What the callbacks need beside Embree's own. Embree hands the address of its part back, which
// stands first.
struct Query {
    RTCIntersectContext embree{};
    RayTest test;
    Hit after, best;
    double most = INFINITY; // what counts is nearer
    std::uint32_t except = kNothing;
    const std::vector<std::uint8_t>* counts = nullptr;
    // The ray of single precision begins at this parameter; its way has length 1.
    double first = 0, length = 1, slack = 0;

    explicit Query(const Ray& ray) : test(ray) { rtcInitIntersectContext(&embree); }

    bool takes(const Hit& hit) const {
        return hit.any() && after.before(hit) && hit.before(best) && hit.t < most &&
               hit.triangle != except &&
               (counts == nullptr || counts->empty() || (*counts)[hit.triangle] != 0);
    }
    float reach(double t) const { return rounded_up((t - first) * length + slack); }
};
static_assert(offsetof(Query, embree) == 0);

// It begins near the triangles, however far away the eye is.
RTCRay single_precision(const Bvh::State& s, const Ray& ray, Query& query) {
    query.length = scanout::sqrt(dot3(ray.way, ray.way));
    query.slack = s.slack();
    const DVec3 way = ray.way / query.length;
    const double nearest = dot3(s.middle - ray.from, way) / query.length;
    query.first = std::max(query.after.t, nearest - 2 * s.radius / query.length);
    const DVec3 from = ray.from + ray.way * query.first - way * s.slack();
    RTCRay made{};
    made.org_x = static_cast<float>(from.x);
    made.org_y = static_cast<float>(from.y);
    made.org_z = static_cast<float>(from.z);
    made.dir_x = static_cast<float>(way.x);
    made.dir_y = static_cast<float>(way.y);
    made.dir_z = static_cast<float>(way.z);
    made.tnear = 0;
    made.tfar =
        query.most < INFINITY ? query.reach(query.most) + 2 * rounded_up(s.slack()) : INFINITY;
    made.mask = 0xffffffff;
    return made;
}

void bounds_of(const RTCBoundsFunctionArguments* arguments) {
    const auto& s = *static_cast<const Bvh::State*>(arguments->geometryUserPtr);
    const Corners& c = s.triangles[arguments->primID];
    const DVec3 low = glm::min(glm::min(c[0], c[1]), c[2]) - DVec3(s.slack()),
                high = glm::max(glm::max(c[0], c[1]), c[2]) + DVec3(s.slack());
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = rounded_down(low.x);
    out.lower_y = rounded_down(low.y);
    out.lower_z = rounded_down(low.z);
    out.upper_x = rounded_up(high.x);
    out.upper_y = rounded_up(high.y);
    out.upper_z = rounded_up(high.z);
}

const Query& query_of(RTCIntersectContext* context) {
    return *reinterpret_cast<const Query*>(context);
}

void meet(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const auto& s = *static_cast<const Bvh::State*>(arguments->geometryUserPtr);
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    const Hit hit = query.test.meets(s.triangles[arguments->primID], arguments->primID);
    if (!query.takes(hit)) return;
    query.best = hit;
    auto& found = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    found.hit.geomID = arguments->geomID;
    // What is as near must still be visited.
    found.ray.tfar = std::min(found.ray.tfar, query.reach(hit.t) + 2 * rounded_up(query.slack));
}

void stand_in_the_way(const RTCOccludedFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const auto& s = *static_cast<const Bvh::State*>(arguments->geometryUserPtr);
    const Query& query = query_of(arguments->context);
    if (query.takes(query.test.meets(s.triangles[arguments->primID], arguments->primID)))
        reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -INFINITY;
}

// Embree asks now and then whether to go on.
bool is_wanted(void* cancelled, double /*share*/) {
    return !*static_cast<const std::atomic<bool>*>(cancelled);
}

} // namespace

Result<Bvh> Bvh::create(std::vector<Corners> triangles, const char* embree,
                        const std::atomic<bool>* cancelled) {
    auto state = std::make_unique<State>();
    State& s = *state;
    s.triangles = std::move(triangles);
    DVec3 low{INFINITY}, high{-INFINITY};
    for (const Corners& c : s.triangles)
        for (const DVec3& p : c) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    if (!s.triangles.empty()) {
        s.middle = (low + high) / 2.0;
        const DVec3 half = (high - low) / 2.0;
        s.radius = std::max(scanout::sqrt(dot3(half, half)), s.radius);
    }
    s.device = rtcNewDevice(embree);
    if (s.device == nullptr) return fail(Exit::internal, "Embree does not start");
    s.scene = rtcNewScene(s.device);
    rtcSetSceneFlags(s.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(s.triangles.size()));
    rtcSetGeometryUserData(geometry, &s);
    rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcSetGeometryOccludedFunction(geometry, stand_in_the_way);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s.scene, geometry);
    rtcReleaseGeometry(geometry);
    if (cancelled != nullptr)
        rtcSetSceneProgressMonitorFunction(s.scene, is_wanted,
                                           const_cast<std::atomic<bool>*>(cancelled));
    rtcCommitScene(s.scene);
    if (cancelled != nullptr && *cancelled) return fail(Exit::usage, "the reference was cancelled");
    if (rtcGetDeviceError(s.device) != RTC_ERROR_NONE)
        return fail(Exit::unreadable,
                    "the reference does not fit into memory: it takes about {} bytes for {} "
                    "triangles",
                    bytes(s.triangles.size()), s.triangles.size());
    return Bvh(std::move(state));
}

Bvh::Bvh(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

std::uint64_t Bvh::bytes(std::size_t triangles) {
    return std::uint64_t{triangles} * (sizeof(Corners) + 160);
}

Hit Bvh::next(const Ray& ray, const Hit& after) const {
    Query query(ray);
    query.after = after;
    RTCRayHit found{};
    found.ray = single_precision(*state_, ray, query);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &query.embree, &found);
    return query.best;
}

bool Bvh::blocked(const Ray& ray, double least, double most, std::uint32_t except,
                  const std::vector<std::uint8_t>& counts) const {
    Query query(ray);
    query.after.t = least;
    query.most = most;
    query.except = except;
    query.counts = &counts;
    RTCRay found = single_precision(*state_, ray, query);
    rtcOccluded1(state_->scene, &query.embree, &found);
    return found.tfar < 0;
}

const Corners& Bvh::corners(std::uint32_t triangle) const {
    return state_->triangles[triangle];
}
double Bvh::radius() const {
    return state_->radius;
}

} // namespace scanout::trace
