// SPDX-License-Identifier: MIT
#include "overlay/boolean.h"

#include <string>
#include <utility>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

namespace {

/// An overlay for one answer: operands as layers that are named by their places, from 1.
class OneAnswer {
 public:
  LayerId add(const MultiPolygon& operand) {
    const LayerId layer = add_layer(FillRule::even_odd);
    for (const Polygon& polygon : operand) {
      add(layer, polygon.outer);
      for (const Ring& hole : polygon.holes) add(layer, hole);
    }
    return layer;
  }

  LayerId add(std::span<const Ring> rings, FillRule rule) {
    const LayerId layer = add_layer(rule);
    for (const Ring& ring : rings) add(layer, ring);
    return layer;
  }

  MultiPolygon answer(Expression what) {
    overlay_.insert(shapes_);
    return overlay_.polygons(overlay_.watch(std::move(what)));
  }

 private:
  LayerId add_layer(FillRule rule) {
    return overlay_.add_layer(std::to_string(overlay_.layer_count() + 1), rule);
  }

  void add(LayerId layer, const Ring& ring) {
    if (!ring.empty()) shapes_.push_back({.layer = layer, .points = ring});
  }

  Overlay overlay_;
  std::vector<Shape> shapes_;
};

template <class Combine>
MultiPolygon combined(const MultiPolygon& a, const MultiPolygon& b, Combine combine) {
  OneAnswer operation;
  const Expression first = operation.add(a);
  const Expression second = operation.add(b);
  return operation.answer(combine(first, second));
}

}  // namespace

MultiPolygon unite(const MultiPolygon& a, const MultiPolygon& b) {
  return combined(a, b, [](const auto& x, const auto& y) { return x | y; });
}

MultiPolygon intersect(const MultiPolygon& a, const MultiPolygon& b) {
  return combined(a, b, [](const auto& x, const auto& y) { return x & y; });
}

MultiPolygon subtract(const MultiPolygon& a, const MultiPolygon& b) {
  return combined(a, b, [](const auto& x, const auto& y) { return x - y; });
}

MultiPolygon exclude(const MultiPolygon& a, const MultiPolygon& b) {
  return combined(a, b, [](const auto& x, const auto& y) { return x ^ y; });
}

MultiPolygon dissolve(std::span<const MultiPolygon> many) {
  OneAnswer operation;
  std::vector<LayerId> layers;
  layers.reserve(many.size());
  for (const MultiPolygon& one : many) layers.push_back(operation.add(one));
  return operation.answer(any_of(layers));
}

MultiPolygon fill(std::span<const Ring> rings, FillRule rule) {
  OneAnswer operation;
  const Expression inside = operation.add(rings, rule);
  return operation.answer(inside);
}

}  // namespace loft::overlay
