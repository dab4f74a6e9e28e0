// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/planar/map.h"
#include "io/planar/paths_svg.h"
#include "io/planar/scene_edits.h"
#include "overlay/overlay.h"
#include "paths/free_space.h"

namespace loft::app {

/// How a scene is taken.
struct SceneRules {
  std::string file = {};                     ///< for messages
  std::optional<std::string> layer_by = {};  ///< the property that names layers; not given: `layer`
  std::optional<std::string> free = {};      ///< an expression over layers
  std::vector<cdt::Point> ends = {};         ///< of queries: the frame goes around them, too
  double largest_radius = 0;                 ///< and leaves room for that
};

/// A scene in an overlay, with what is free in it, and its features by their names.
///
/// Polygons are in the layer that a property names, `obstacles` where they have none. Within a
/// layer they are united, whatever the directions of their rings. All lines are walls, in a layer
/// `walls`. The layer `frame` is the box around everything, a tenth larger, with room for the
/// largest disc; it is there if no layer is called `frame` or, unless an expression is given,
/// `free`. What is free by default: `free`, or the frame, less all other layers of polygons.
class PathScene {
 public:
  /// Throws InputError where no feature has the property that was asked for, UsageError where the
  /// expression makes no sense.
  PathScene(const io::Map& map, const SceneRules& rules);

  /// Throws InputError that lists edits of features that are not there, or are several, or no
  /// single ring or line where that is needed, and layers that are not there. `file` is theirs.
  void check(std::span<const io::SceneEdit> edits, const std::string& file) const;
  /// Precondition: it is the next one of those that were checked. Throws InputError if it leads to
  /// coordinates that are not usable.
  void apply(const io::SceneEdit& edit);

  [[nodiscard]] const paths::FreeSpace& space() const { return *space_; }
  [[nodiscard]] const overlay::Overlay& overlay() const { return overlay_; }
  /// The scene as it is now, without paths.
  [[nodiscard]] io::PathPicture picture();

 private:
  void add_layers(const io::Map& map, const SceneRules& rules, const std::string& property);
  void add_features(const io::Map& map, const std::string& property);
  [[nodiscard]] overlay::Expression free_by_default() const;
  [[nodiscard]] overlay::LayerId layer(const std::string& name);
  void change(const io::SceneEdit& edit);
  void reshape(const io::SceneEdit& edit);
  void insert(const io::SceneEdit& edit);

  overlay::Overlay overlay_;
  std::map<std::string, overlay::LayerId> layers_;  // of polygons, and the frame
  overlay::LayerId walls_;
  std::map<std::string, std::vector<overlay::RingId>> features_;
  std::set<std::string> ambiguous_;  // names of several features
  overlay::Expression free_;
  std::optional<paths::FreeSpace> space_;
};

}  // namespace loft::app
