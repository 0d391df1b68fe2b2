// CameraScene: what cameras see of a run at a tick. It is made of a VisualWorld; an update touches only what
// moved.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/thread_pool.h"
#include "model/robot_state.h"
#include "render/visual_world.h"

namespace roboss {

/// Not for use by several threads at once; it shares its work out over threads itself.
class CameraScene {
  public:
    /// `threads`: that images are shared out over. No bit depends on it.
    CameraScene(std::shared_ptr<const Model> model, std::shared_ptr<const render::VisualWorld> world,
                unsigned threads);
    ~CameraScene();
    CameraScene(const CameraScene&) = delete;
    CameraScene& operator=(const CameraScene&) = delete;

    /// Moves the visuals of every robot to its state; states[i] belongs to RobotId i.
    void update(std::span<const RobotState* const> states);

    const render::VisualWorld& world() const { return *world_; }
    const render::TraceWorld& trace() const { return trace_; }
    /// By number of an item of trace().
    const render::TraceItem& item(std::uint32_t number) const { return items_[number]; }
    const render::VisualShape& shape(std::uint32_t number) const { return *shapes_[number]; }
    /// Of an item, along the axes of the world.
    Aabb box_W(std::uint32_t number) const;

    /// What has a label: a model, or a visual of its own.
    struct Thing {
        int label = 0;
        std::uint16_t of_label = 0;        // which one of its label, from 1
        std::vector<std::uint32_t> items;  // of trace()
        std::optional<RobotId> robot;      // along whose axes its box lies; none: those of its first item
    };
    static constexpr std::uint32_t kNoThing = 0xFFFFFFFFu;
    const std::vector<Thing>& things() const { return things_; }
    /// The thing that an item belongs to, or kNoThing.
    std::uint32_t thing_of(std::uint32_t item) const { return thing_of_[item]; }

    /// Items of a link, or of a whole static model, from the first to before the last.
    struct Items {
        std::uint32_t first = 0, last = 0;
    };
    Items items_of(RobotId robot, LinkId link) const;

    struct Light {
        LightSpec spec;
        Vec3 position_W, direction_W;
    };
    const std::vector<Light>& lights() const { return lights_; }

    /// Calls work(i) for each i below count, on all threads.
    void share_out(std::size_t count, const std::function<void(std::size_t)>& work) const;

  private:
    void add_scenery();
    Items items_of_scenery(const std::string& model) const;
    void add_robots();
    void add_item(const render::VisualShape& shape);
    void name_things();
    void place(std::uint32_t item, const Transform& X_WF);
    void place_lights();
    void grow_moving_tree();

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const render::VisualWorld> world_;
    mutable ThreadPool pool_;
    std::vector<render::TraceItem> items_;                 // scenery, then robots by link
    std::vector<const render::VisualShape*> shapes_;       // by item
    std::vector<std::uint32_t> thing_of_;                  // by item
    std::vector<std::vector<std::uint32_t>> link_starts_;  // by robot and link, and where the last one ends
    std::vector<Thing> things_;
    std::vector<std::vector<double>> q_;  // by robot, as placed last; empty: not yet
    std::vector<std::vector<Transform>> links_W_;
    std::vector<Light> lights_;
    std::uint32_t moving_from_ = 0;  // item
    render::BoxTree still_, moving_;
    render::TraceWorld trace_;
};

/// The CameraScene of a Model whose visuals `visuals` makes; its errors.
Result<std::unique_ptr<CameraScene>> make_camera_scene(const render::VisualsOf& visuals,
                                                       std::shared_ptr<const Model> model, unsigned threads);

}  // namespace roboss
