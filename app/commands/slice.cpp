// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/terminal.h"
#include "io/meshes.h"
#include "io/stack_writer.h"
#include "mesh/sections.h"
#include "reconstruct/defect.h"

namespace loft::app {

namespace {

/// More slices than that are a slip of the pen.
constexpr double most_slices = 1e6;

/// A frame whose slices are across a direction, as upright as they can be.
WorldFrame frame_across(const Vec3& direction) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  const Vec3 n{direction[0] / length, direction[1] / length, direction[2] / length};
  // The axis that is least along n gives the first one of the slices.
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[least])) least = i;
  Vec3 u{};
  u[least] = 1;
  for (std::size_t i = 0; i < 3; ++i) u[i] -= n[least] * n[i];
  const double size = std::hypot(u[0], u[1], u[2]);
  for (double& coordinate : u) coordinate /= size;
  const Vec3 v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  WorldFrame frame;
  for (std::size_t i = 0; i < 3; ++i) frame.rows[i] = {u[i], v[i], n[i], 0};
  return frame;
}

/// From the world into the slices: frames here only turn.
void turn_back(const WorldFrame& frame, Mesh& mesh) {
  for (Vec3& point : mesh.points) {
    Vec3 turned{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) turned[i] += frame.rows[k][i] * point[k];
    point = turned;
  }
}

/// Half a gap within the lowest and the highest point, and a gap apart.
std::vector<double> heights_at(double gap, const std::vector<io::LabelledMesh>& meshes) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& [label, mesh, colour] : meshes)
    for (const Vec3& point : mesh.points) {
      low = std::min(low, point[2]);
      high = std::max(high, point[2]);
    }
  const double count = std::floor((high - low) / gap + 0.5);
  if (!(count <= most_slices))
    throw InputError("a gap of " + rounded(gap) + " would make " + rounded(count) +
                     " slices; give a wider one");
  std::vector<double> heights;
  for (double i = 0; i < count; ++i) heights.push_back(low + (i + 0.5) * gap);
  return heights;
}

void add_sections(const io::LabelledMesh& part, const std::vector<double>& heights, Stack& stack,
                  std::size_t& open) {
  const std::vector<Section> made = sections(part.mesh, heights);
  for (std::size_t i = 0; i < made.size(); ++i) {
    open += made[i].open;
    for (const auto& outline : made[i].outlines)
      stack.slices[i].contours.push_back({outline, part.label});
  }
}

}  // namespace

ExitCode run(const SliceCommand& command) {
  Terminal terminal(command.quiet);
  forbid_overwriting({&command.mesh, 1}, {&command.output, 1});
  io::check_stack_writable(command.output);
  std::vector<io::LabelledMesh> meshes = io::read_meshes(command.mesh);
  Stack stack;
  stack.fill = Fill::nonzero;
  if (command.normal != Vec3{0, 0, 1}) {
    stack.frame = frame_across(command.normal);
    for (io::LabelledMesh& part : meshes) turn_back(*stack.frame, part.mesh);
  }
  std::vector<double> heights = command.heights;
  if (command.gap) heights = heights_at(*command.gap, meshes);
  for (const double z : heights) stack.slices.push_back({z, {}});
  std::size_t open = 0;
  for (const io::LabelledMesh& part : meshes) add_sections(part, heights, stack, open);
  std::size_t contours = 0;
  for (const Slice& slice : stack.slices) contours += slice.contours.size();
  if (contours == 0)
    throw InputError(command.mesh.string() + ": no slice meets the mesh; give other heights");
  if (open > 0)
    terminal.warn(command.mesh.string() + ": the mesh is not closed; " + grouped(open) +
                  " outlines end at its rim and are left out");
  for (const std::string& loss : io::write_stack(command.output, stack)) terminal.warn(loss);
  terminal.say(counted(stack.slices.size(), "slice") + ", " + counted(contours, "contour"));
  terminal.say("wrote " + command.output.string());
  return ExitCode::ok;
}

}  // namespace loft::app
