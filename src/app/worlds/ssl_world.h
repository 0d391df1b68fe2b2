// A field of RoboCup's Small Size League with two teams and a golf ball as an SDF 1.9 world. Its robots have
// four omnidirectional wheels and a dribbler.
#pragma once

#include <string>

#include "app/worlds/ssl_field.h"

namespace roboss {

std::string ssl_sdf(const soccer::SslField& field);

}  // namespace roboss
