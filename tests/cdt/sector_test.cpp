// SPDX-License-Identifier: MIT
#include "cdt/sector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/cdt/player.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

std::vector<EdgeId> sector(const Triangulation& mesh, EdgeId e) {
  std::vector<EdgeId> edges;
  visit_sector(mesh, e, [&](EdgeId each) { edges.push_back(each); });
  return edges;
}

TEST(Sector, IsAllAroundWhereNothingIsConstrained) {
  Triangulation mesh;
  const VertexId v = mesh.insert({0, 0});
  for (const Point p : {Point{1, 0}, Point{0, 1}, Point{-1, 0}, Point{0, -1}}) mesh.insert(p);
  EXPECT_EQ(sector(mesh, mesh.edge(v)).size(), 4U);
  EXPECT_EQ(sector(mesh, mesh.edge(v)).front(), mesh.edge(v));
}

TEST(Sector, EndsAtConstrainedEdges) {
  Triangulation mesh;
  const VertexId v = mesh.insert({0, 0});
  for (const Point p : {Point{1, 1}, Point{-1, 1}, Point{0, -3}}) mesh.insert(p);
  mesh.insert(std::vector<Point>{{-2, 0}, {0, 0}, {2, 0}}, open);
  const EdgeId right = *mesh.find_edge(v, mesh.from(mesh.locate({2, 0}).edge));
  EXPECT_EQ(sector(mesh, right).size(), 3U);  // above: to (1, 1), to (-1, 1), to (-2, 0)
  EXPECT_EQ(sector_begin(mesh, mesh.rotated(right)), right);
}

TEST(Sector, SectorsAreAPartitionOfWhatIsAroundAVertex) {
  for (const Ground ground : all_grounds) {
    SCOPED_TRACE(name_of(ground));
    Player player;
    for (const Edit& edit : random_script(5, ground, 60, 8)) player.play(edit);
    const Triangulation& mesh = player.mesh();
    for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i) {
      if (!mesh.is_vertex(VertexId(i)) || mesh.edge(VertexId(i)).is_none()) continue;
      const EdgeId start = mesh.edge(VertexId(i));
      EdgeId e = start;
      do {
        std::vector<EdgeId> here = sector(mesh, e);
        EXPECT_TRUE(std::ranges::find(here, e) != here.end());
        for (std::size_t k = 1; k < here.size(); ++k) EXPECT_FALSE(mesh.is_constrained(here[k]));
        for (const EdgeId other : here) {
          std::vector<EdgeId> same = sector(mesh, other);
          std::ranges::sort(same);
          std::ranges::sort(here);
          EXPECT_EQ(same, here);
        }
        e = mesh.rotated(e);
      } while (e != start);
    }
  }
}

}  // namespace
}  // namespace loft::cdt
