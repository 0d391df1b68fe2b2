// See run_services.h. A run has one world, from its beginning to its end.
#include <algorithm>
#include <filesystem>

#include "ros2/run_services.h"
#include "ros2_types/messages/simulation_services_v1.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;
namespace v1 = simulation_interfaces_v1;

namespace {

si::Result unsupported(const char* why) {
    return result_of(si::Result::kFeatureUnsupported, why);
}

si::WorldResource world_of(const SimulationContext& c, const RunStatus& status) {
    return {c.run.model().name, {status.world, ""}, "the world of the run", {}};
}

void add_places(const SimulationContext& c) {
    constexpr const char* kNone = "no places of this world have names";
    c.table.add<si::GetNamedPoses>(c.name("get_named_poses"), [c](const si::GetNamedPoses::Request& request,
                                                                  const Reply<si::GetNamedPoses>& reply) {
        si::GetNamedPoses::Response response;
        response.result = c.options.places.empty() ? unsupported(kNone) : fine();
        if (is_too_long(request.tags))
            return reply({result_of(si::Result::kOperationFailed, "the filter has too many tags"), {}});
        for (const NamedPlace& place : c.options.places)
            if (fits(place.pose.tags, request.tags)) response.poses.push_back(place.pose);
        reply(response);
    });
    c.table.add<si::GetNamedPoseBounds>(
        c.name("get_named_pose_bounds"),
        [c](const si::GetNamedPoseBounds::Request& request, const Reply<si::GetNamedPoseBounds>& reply) {
            si::GetNamedPoseBounds::Response response;
            const auto place = std::ranges::find_if(
                c.options.places, [&](const NamedPlace& p) { return p.pose.name == request.name; });
            if (c.options.places.empty())
                response.result = unsupported(kNone);
            else if (place == c.options.places.end())
                response.result = result_of(si::Result::kNotFound, "there is no such place");
            else
                response = {fine(), place->bounds};
            reply(response);
        });
}

/// True if a URI names the world that the run has.
bool is_this_world(const std::string& uri, const std::string& world) {
    constexpr std::string_view kFile = "file://";
    const std::string path = uri.starts_with(kFile) ? uri.substr(kFile.size()) : uri;
    return !path.empty() &&
           std::filesystem::path(path).lexically_normal() == std::filesystem::path(world).lexically_normal();
}

/// The world that the run has is loaded by returning to its beginning; there can be no other.
void load(const SimulationContext& c, RunMemory& memory, const si::LoadWorld::Request& request,
          const Reply<si::LoadWorld>& reply) {
    const si::Resource& wanted = request.world_resource;
    if (wanted.uri.empty() && wanted.resource_string.empty())
        return reply(
            {result_of(si::LoadWorld::Response::kNoResource, "neither a URI nor a world is given"), {}});
    c.waits.ask_status([c, &memory, uri = wanted.uri, reply](const RunStatus* status) {
        if (status == nullptr)
            return reply({result_of(si::Result::kOperationFailed, "the run did not answer"), {}});
        if (!is_this_world(uri, status->world))
            return reply({unsupported("a run keeps its world: start another run with the other world"), {}});
        const si::WorldResource world = world_of(c, *status);
        stop_run(c, memory, [world, reply](const si::Result& result) {
            reply({result, result.result == si::Result::kOk ? world : si::WorldResource{}});
        });
    });
}

}  // namespace

void add_world_services(const SimulationContext& c, RunMemory& memory) {
    add_places(c);
    c.table.add<si::GetCurrentWorld>(
        c.name("get_current_world"), [c](const auto&, const Reply<si::GetCurrentWorld>& reply) {
            c.waits.ask_status([c, reply](const RunStatus* status) {
                if (status == nullptr)
                    return reply({result_of(si::Result::kOperationFailed, "the run did not answer"), {}});
                reply({fine(), world_of(c, *status)});
            });
        });
    c.table.add<si::GetAvailableWorlds>(
        c.name("get_available_worlds"),
        [c](const si::GetAvailableWorlds::Request& request, const Reply<si::GetAvailableWorlds>& reply) {
            c.waits.ask_status(
                [c, reply, wants_tags = !request.filter.tags.empty()](const RunStatus* status) {
                    if (status == nullptr)
                        return reply({result_of(si::Result::kOperationFailed, "the run did not answer"), {}});
                    si::GetAvailableWorlds::Response response{fine(), {}};
                    if (!wants_tags) response.worlds.push_back(world_of(c, *status));  // it has none
                    reply(response);
                });
        });
    // A request of 1.x has the same bytes.
    c.table.add_raw<si::LoadWorld>(c.name("load_world"), c.type<v1::LoadWorld, si::LoadWorld>(),
                                   [c, &memory](const Incoming& call, const Reply<si::LoadWorld>& reply) {
                                       const auto request = from_cdr<si::LoadWorld::Request>(call.bytes);
                                       if (!request)
                                           return c.table.notice("load_world: " + request.error().message);
                                       load(c, memory, request.value(), reply);
                                   });
    c.table.add<si::UnloadWorld>(
        c.name("unload_world"), [](const auto&, const Reply<si::UnloadWorld>& reply) {
            reply({unsupported("a run has its world to its end: end the run instead")});
        });
}

}  // namespace roboss::ros2
