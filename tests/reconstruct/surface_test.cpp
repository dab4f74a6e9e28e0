// SPDX-License-Identifier: MIT
#include "reconstruct/surface.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/mesh/shapes.h"

namespace loft {
namespace {

using shapes::cube;

TEST(Surface, IsChecked) {
  Surface surface;
  std::vector<Surface::VertexHandle> vertices;
  const Mesh mesh = cube({0, 0, 0}, 1);
  for (const Vec3& p : mesh.points) vertices.push_back(surface.add_vertex({p[0], p[1], p[2]}));
  for (const auto& [a, b, c] : mesh.faces) {
    surface.add_face(vertices[a], vertices[b], vertices[c]);
  }
  EXPECT_TRUE(check(surface).empty());
  EXPECT_EQ(to_mesh(surface), mesh);
}

}  // namespace
}  // namespace loft
