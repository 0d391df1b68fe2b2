// The files of src/app/templates as text, which CMake embeds. @NAME@ and the like are to be replaced.
#pragma once

namespace roboss::templates {

extern const char* const kCMakeLists;
extern const char* const kProgram;
extern const char* const kRover;
extern const char* const kWorld;
extern const char* const kReadme;

}  // namespace roboss::templates
