// A model from MJCF text, in the releases of MuJoCo that tests and benchmarks meet: Debian 12's 2.2 and those
// since 3.1.
#pragma once

#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>
#include <string>

namespace roboss::test {

/// nullptr: MuJoCo refuses it, `error` says why.
inline mjModel* load_mjcf(const std::string& xml, std::string& error) {
    constexpr const char* kName = "world.xml";
    auto files = std::make_unique<mjVFS>();  // large in version 2
    mj_defaultVFS(files.get());
#if mjVERSION_HEADER >= 310
    mj_addBufferVFS(files.get(), kName, xml.data(), static_cast<int>(xml.size()));
#else
    mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), kName)], xml.data(), xml.size());
#endif
    char text[1000] = "";
    mjModel* model = mj_loadXML(kName, files.get(), text, sizeof text);
    mj_deleteVFS(files.get());
    error = text;
    return model;
}

}  // namespace roboss::test
