// The protocols by name. A new one is a header, a source file, and a line here.
#include "device/adapter.h"

#include <random>

#include "device/joints.h"
#include "device/khepera.h"

namespace roboss {

Result<std::unique_ptr<DeviceAdapter>> make_adapter(const std::string& protocol, const Model& model,
                                                    RobotId robot) {
    if (protocol == "khepera") return KheperaAdapter::create(model, robot);
    if (protocol == "joints")
        return std::unique_ptr<DeviceAdapter>(new JointsAdapter(model, robot, std::random_device()()));
    return Error{"there is no protocol '" + protocol + "'", "choose khepera or joints", "no-protocol"};
}

}  // namespace roboss
