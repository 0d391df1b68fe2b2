// The services of simulation_interfaces that ask about entities and change them.
#pragma once

#include "ros2/simulation_context.h"
#include "ros2/spawner.h"

namespace roboss::ros2 {

/// GetEntities, GetEntitiesStates, GetEntityState, SetEntityState, GetEntityInfo, SetEntityInfo,
/// GetEntityBounds.
void add_entity_services(const SimulationContext& c);

/// SpawnEntity, SpawnEntities, DeleteEntity, GetSpawnables. Spawner and folders outlive them.
void add_spawn_services(const SimulationContext& c, Spawner& spawner, const ModelFolders& folders);

/// Sets pose or velocity of an entity as asked for, or says why it cannot.
simulation_interfaces::Result set_entity_state(const SimulationContext& c,
                                               const simulation_interfaces::SetEntityState::Request& wanted);

}  // namespace roboss::ros2
