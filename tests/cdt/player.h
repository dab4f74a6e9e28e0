// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "tests/cdt/edits.h"

namespace loft::cdt {

/// A triangulation that follows a script, and the ids of its constraints by name.
class Player {
 public:
  explicit Player(double epsilon = 0) : mesh_(epsilon) {}
  /// Another triangulation that stands where the other player's does.
  Player(Triangulation mesh, const Player& other)
      : mesh_(std::move(mesh)), constraints_(other.constraints_), ids_(other.ids_) {}

  /// What does not apply does nothing.
  void play(const Edit& edit) {
    if (!applies(edit, constraints_)) return;
    switch (edit.kind) {
      case Edit::Kind::insert:
        ids_[edit.name] = mesh_.insert(edit.outline.points, edit.outline.ends);
        break;
      case Edit::Kind::remove:
        mesh_.remove(ids_.at(edit.name));
        ids_.erase(edit.name);
        break;
      case Edit::Kind::move:
        mesh_.move(ids_.at(edit.name), edit.outline.points);
        break;
      case Edit::Kind::translate:
        mesh_.translate(ids_.at(edit.name), edit.by);
        break;
    }
    carry_out(edit, constraints_);
  }

  [[nodiscard]] Triangulation& mesh() { return mesh_; }
  [[nodiscard]] const Triangulation& mesh() const { return mesh_; }
  /// In the order of the names, as outlines().
  [[nodiscard]] std::vector<ConstraintId> ids() const {
    std::vector<ConstraintId> ids;
    for (const auto& [name, id] : ids_) ids.push_back(id);
    return ids;
  }
  [[nodiscard]] std::vector<Outline> outlines() const {
    std::vector<Outline> outlines;
    for (const auto& [name, outline] : constraints_) outlines.push_back(outline);
    return outlines;
  }

 private:
  Triangulation mesh_;
  Constraints constraints_;
  std::map<std::size_t, ConstraintId> ids_;
};

}  // namespace loft::cdt
