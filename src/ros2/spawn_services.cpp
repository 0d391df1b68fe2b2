// See entity_services.h.
#include "ros2/entity_services.h"
#include "ros2_types/messages/simulation_services_v1.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;
namespace v1 = simulation_interfaces_v1;

namespace {

constexpr std::size_t kMostAtOnce = 1'000;  // spawn requests of one call

/// A spawn request of any layout that has these fields.
template <class Request>
Spawn spawn_of(const Request& r) {
    return {r.name,
            r.allow_renaming,
            r.entity_namespace,
            r.entity_resource.uri,
            r.entity_resource.uri.empty() ? r.entity_resource.resource_string : "",
            r.initial_pose.header.frame_id,
            r.initial_pose.pose};
}

/// Replies once the last of several is spawned.
void spawn_all(Spawner& spawner, const std::vector<si::SpawnRequest>& requests,
               const Reply<si::SpawnEntities>& reply) {
    const auto results = std::make_shared<si::SpawnEntities::Response>();
    results->result = fine();
    results->results.resize(requests.size());
    if (requests.empty()) return reply(*results);
    const auto left = std::make_shared<std::size_t>(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i)  // they are served in this order
        spawner.spawn(spawn_of(requests[i]),
                      [results, reply, left, i](const si::Result& result, const std::string& name) {
                          results->results[i] = {result, name};
                          if (result.result != si::Result::kOk)
                              results->result = result_of(si::SpawnEntities::Response::kEntitiesSpawnFailed,
                                                          "at least one was not spawned: see its result");
                          if (--*left == 0) reply(*results);
                      });
}

std::string list_of_unknown(const std::vector<std::string>& sources) {
    std::string text;
    for (const std::string& source : sources) {
        if (text.size() > 1'000) return text + " ...";
        text += (text.empty() ? "these sources are not known: " : ", ") + source.substr(0, 200);
    }
    return text;
}

/// The files, in the layout of the client or, if it does not say which, in that of the option.
void reply_spawnables(const SimulationContext& c, const ModelFolders& folders, const Incoming& call,
                      const Reply<si::GetSpawnables>& reply) {
    const auto request = from_cdr<si::GetSpawnables::Request>(call.bytes);
    if (!request) return c.table.notice("get_spawnables: " + request.error().message);
    const si::Result result = result_of(si::Result::kOk, list_of_unknown(request.value().sources));
    const bool is_known = call.peer_type == type_of_service<v1::GetSpawnables>().hash ||
                          call.peer_type == type_of_service<si::GetSpawnables>().hash;
    const bool is_old =
        is_known ? call.peer_type == type_of_service<v1::GetSpawnables>().hash : c.options.version == 1;
    si::GetSpawnables::Response response{result, {}};
    v1::GetSpawnables::Response older{result, {}};
    for (const ModelFile& file : folders.list()) {
        response.spawnables.push_back({{file.uri, ""}, file.description, {}});
        older.spawnables.push_back({file.uri, file.description, {}});
    }
    reply.give(is_old ? to_cdr(older) : to_cdr(response));
}

}  // namespace

void add_spawn_services(const SimulationContext& c, Spawner& spawner, const ModelFolders& folders) {
    // A request of 1.x has the same bytes.
    c.table.add_raw<si::SpawnEntity>(
        c.name("spawn_entity"), c.type<v1::SpawnEntity, si::SpawnEntity>(),
        [c, &spawner](const Incoming& call, const Reply<si::SpawnEntity>& reply) {
            const auto request = from_cdr<si::SpawnEntity::Request>(call.bytes);
            if (!request) return c.table.notice("spawn_entity: " + request.error().message);
            spawner.spawn(spawn_of(request.value()),
                          [reply](const si::Result& result, const std::string& name) {
                              reply({result, name});
                          });
        });
    c.table.add<si::SpawnEntities>(
        c.name("spawn_entities"),
        [&spawner](const si::SpawnEntities::Request& request, const Reply<si::SpawnEntities>& reply) {
            if (request.spawn_requests.size() <= kMostAtOnce)
                return spawn_all(spawner, request.spawn_requests, reply);
            reply({result_of(si::Result::kOperationFailed,
                             "at most " + std::to_string(kMostAtOnce) + " entities are spawned by one call"),
                   {}});
        });
    c.table.add<si::DeleteEntity>(
        c.name("delete_entity"),
        [c, &spawner](const si::DeleteEntity::Request& request, const Reply<si::DeleteEntity>& reply) {
            if (!c.entities.find(request.entity))
                return reply({result_of(si::Result::kNotFound,
                                        "there is no entity '" + request.entity.substr(0, 200) + "'")});
            spawner.remove({request.entity}, [reply](const si::Result& result) { reply({result}); });
        });
    c.table.add_raw<si::GetSpawnables>(
        c.name("get_spawnables"), c.type<v1::GetSpawnables, si::GetSpawnables>(),
        [c, &folders](const Incoming& call, const Reply<si::GetSpawnables>& reply) {
            reply_spawnables(c, folders, call, reply);
        });
}

}  // namespace roboss::ros2
