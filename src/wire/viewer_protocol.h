// Numbers of the binary messages between gateway and page (docs/viewer-protocol.md): places of fields in
// bytes, limits. Made by tools/viewer_protocol from src/gateway/protocol.json: change that and run the
// tool.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roboss::viewer_protocol {

inline constexpr int kVersion = 1;
inline constexpr char kSubprotocol[] = "roboss.1";
inline constexpr std::size_t kMessageBytesMax = 65536;
inline constexpr std::size_t kAdditionBytesMax = 4194304;
inline constexpr std::size_t kMessagesASecondMax = 200;
inline constexpr std::size_t kWatchedRobotsMax = 8;
inline constexpr std::size_t kWatchedCamerasMax = 16;
inline constexpr std::size_t kPictureColumnsMax = 1280;
inline constexpr std::size_t kRateMax = 60;
inline constexpr std::uint8_t kFlagWhole = 1;
inline constexpr std::uint8_t kFlagRest = 2;
inline constexpr std::uint8_t kFlagPreview = 4;

inline constexpr std::uint8_t kStateKind = 1;
inline constexpr std::size_t kStateKindAt = 0;
inline constexpr std::size_t kStateFlagsAt = 1;
inline constexpr std::size_t kStateReservedAt = 2;
inline constexpr std::size_t kStateSceneAt = 4;
inline constexpr std::size_t kStateTickAt = 8;
inline constexpr std::size_t kStateTimeAt = 16;
inline constexpr std::size_t kStateRobotsAt = 24;
inline constexpr std::size_t kStateBytes = 28;
inline constexpr std::size_t kStateEntryRobotAt = 0;
inline constexpr std::size_t kStateEntryPositionAt = 4;
inline constexpr std::size_t kStateEntryOrientationAt = 16;
inline constexpr std::size_t kStateEntryCoordinatesAt = 24;
inline constexpr std::size_t kStateEntryBytes = 24;
inline constexpr int kStateOrientationScale = 32767;
inline constexpr int kStateCoordinateScale = 32767;

inline constexpr std::uint8_t kPictureKind = 2;
inline constexpr std::size_t kPictureKindAt = 0;
inline constexpr std::size_t kPictureReservedAt = 1;
inline constexpr std::size_t kPictureReserved2At = 2;
inline constexpr std::size_t kPictureSceneAt = 4;
inline constexpr std::size_t kPictureTickAt = 8;
inline constexpr std::size_t kPictureTimeAt = 16;
inline constexpr std::size_t kPictureRobotAt = 24;
inline constexpr std::size_t kPictureSensorAt = 28;
inline constexpr std::size_t kPictureAboutBytesAt = 32;
inline constexpr std::size_t kPictureBytes = 36;

// clang-format off
/// What a page can draw beside robots and scenery.
inline constexpr const char* kPageOverlays[] = {
    "rays", "points", "tracks", "compass", "contacts", "radio", "bounds", "spheres", "islands",
    "names", "collisions", "frames", "masses", "inertia", "axes", "labels", "wireframe",
    "transparent"
};
// clang-format on

}  // namespace roboss::viewer_protocol
