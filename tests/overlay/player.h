// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "overlay/overlay.h"
#include "tests/cdt/edits.h"

namespace loft::overlay {

/// Some expressions over the three layers of a player.
[[nodiscard]] inline std::vector<Expression> some_expressions() {
  const Expression a = LayerId(0);
  const Expression b = LayerId(1);
  const Expression c = LayerId(2);
  return {a,
          b,
          c,
          a | b,
          a & b,
          a - b,
          a ^ b,
          (a | b) - c,
          at_least(2, std::vector{a, b, c}),
          exactly(1, std::vector{a, b, c})};
}

/// An overlay that follows a script of edits: the constraints are rings and lines of three layers,
/// one of even-odd, nonzero and positive each.
class Player {
 public:
  Player() {
    overlay_.add_layer("even-odd", FillRule::even_odd);
    overlay_.add_layer("nonzero", FillRule::nonzero);
    overlay_.add_layer("positive", FillRule::positive);
    for (const Expression& what : some_expressions()) results_.push_back(overlay_.watch(what));
  }

  void play(const cdt::Edit& edit) {
    using Kind = cdt::Edit::Kind;
    if (!applies(edit, constraints_)) return;
    switch (edit.kind) {
      case Kind::insert:
        rings_[edit.name] =
            overlay_.insert(layer_of(edit.name), edit.outline.points, edit.outline.ends);
        break;
      case Kind::remove:
        overlay_.remove(rings_.at(edit.name));
        rings_.erase(edit.name);
        break;
      case Kind::move:
        overlay_.move(rings_.at(edit.name), edit.outline.points);
        break;
      case Kind::translate:
        overlay_.translate(rings_.at(edit.name), edit.by);
        break;
    }
    carry_out(edit, constraints_);
  }

  [[nodiscard]] Overlay& overlay() { return overlay_; }
  [[nodiscard]] const Overlay& overlay() const { return overlay_; }
  [[nodiscard]] const std::vector<ResultId>& results() const { return results_; }

  /// The same shapes, at once.
  [[nodiscard]] Player fresh() const {
    Player result;
    std::vector<Shape> shapes;
    for (const auto& [name, outline] : constraints_)
      shapes.push_back({layer_of(name), outline.points, outline.ends});
    const auto rings = result.overlay_.insert(shapes);
    std::size_t i = 0;
    for (const auto& [name, outline] : constraints_) result.rings_[name] = rings[i++];
    result.constraints_ = constraints_;
    return result;
  }

 private:
  [[nodiscard]] static LayerId layer_of(std::size_t name) {
    return LayerId(static_cast<std::uint32_t>(name % 3));
  }

  Overlay overlay_;
  std::vector<ResultId> results_;
  cdt::Constraints constraints_;
  std::map<std::size_t, RingId> rings_;
};

}  // namespace loft::overlay
