// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/each_file.h"
#include "app/commands/label_volumes.h"
#include "app/json.h"
#include "app/report.h"
#include "io/bytes/file.h"
#include "io/meshes.h"
#include "io/stack.h"
#include "io/stacks/stack_line.h"
#include "mesh/measure.h"
#include "reconstruct/world.h"

namespace loft::app {

namespace {

/// The box around some places; empty at first.
struct Bounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity};
  Vec3 high{-infinity, -infinity, -infinity};

  void add(const Vec3& place) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }
  [[nodiscard]] bool is_empty() const { return !(low[0] <= high[0]); }
};

/// What there is to know about a stack without reconstructing it.
struct StackSummary {
  StackSize size;
  std::size_t empty_slices = 0;
  Bounds bounds;
  std::vector<double> gaps;  ///< between neighbouring heights, sorted
  std::map<std::string, StackSize> labels;
  std::map<std::string, LabelVolume> volumes;  ///< where they were asked for
  Stack about;                                 ///< without slices
};

/// More labels than that are no list for people.
constexpr std::size_t most_lines = 60;

StackSummary summarise(Stack stack, const InfoCommand& command) {
  StackSummary summary;
  summary.size = size_of(stack.slices);
  std::vector<double> heights;
  for (std::uint32_t s = 0; s < stack.slices.size(); ++s) {
    const Slice& slice = stack.slices[s];
    heights.push_back(slice.z);
    if (slice.contours.empty()) ++summary.empty_slices;
    add_sizes(summary.labels, slice);
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c) {
      const auto& points = slice.contours[c].points;
      for (std::uint32_t p = 0; p < points.size(); ++p)
        summary.bounds.add(world_place(stack, {points[p].x, points[p].y, slice.z},
                                       {VertexKind::contour, s, c, p}));
    }
  }
  summary.size.slices = stack.slices.size();
  for (const StackLabel& label : stack.labels) summary.labels.try_emplace(label.name);
  std::ranges::sort(heights);
  for (std::size_t i = 1; i < heights.size(); ++i) {
    summary.gaps.push_back(heights[i] - heights[i - 1]);
  }
  std::ranges::sort(summary.gaps);
  if (command.volumes && (command.json || summary.labels.size() <= most_lines))
    summary.volumes = label_volumes(stack);
  stack.slices.clear();
  summary.about = std::move(stack);
  return summary;
}

Json to_json(const Bounds& bounds) {
  if (bounds.is_empty()) return {};
  return {{"low", bounds.low}, {"high", bounds.high}};
}

void print_bounds(const Bounds& bounds) {
  if (bounds.is_empty()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::cout << (axis == 0 ? "  " : ", ") << "xyz"[axis] << ' ' << rounded(bounds.low[axis])
              << " to " << rounded(bounds.high[axis]);
  }
  std::cout << '\n';
}

Json to_json(const WorldFrame& frame) {
  Json numbers = Json::array();
  for (const auto& row : frame.rows)
    for (const double number : row) numbers.push_back(number);
  return numbers;
}

/// `loft info STACK --json`: schema "loft-info", schema_version 1, file, kind "stack", counts,
/// unit, fill and frame (16 numbers, row by row) where the file says them, else null; bounds (low
/// and high corner, in the world), gaps (min, median, max; null for one slice), labels (label,
/// counts, colour `#rrggbb`, id and kind, empty where there is none; volume, that which the surface
/// encloses, and slab_volume, that of slices as thick as their gaps: see Reconstructed; null
/// without a surface, or with --no-volumes), notes (what is left out).
Json to_json(const StackSummary& summary) {
  Json json;
  json["kind"] = "stack";
  json["slices"] = summary.size.slices;
  json["empty_slices"] = summary.empty_slices;
  json["contours"] = summary.size.contours;
  json["vertices"] = summary.size.vertices;
  const Stack& about = summary.about;
  json["unit"] = about.unit.empty() ? Json() : Json(about.unit);
  json["fill"] = about.fill ? Json(name(*about.fill)) : Json();
  json["frame"] = about.frame ? to_json(*about.frame) : Json();
  json["bounds"] = to_json(summary.bounds);
  const std::vector<double>& gaps = summary.gaps;
  json["gaps"] =
      gaps.empty()
          ? Json()
          : Json{{"min", gaps.front()}, {"median", gaps[gaps.size() / 2]}, {"max", gaps.back()}};
  json["labels"] = Json::array();
  for (const auto& [label, size] : summary.labels) {
    json["labels"].push_back({{"label", label},
                              {"slices", size.slices},
                              {"contours", size.contours},
                              {"vertices", size.vertices}});
    const StackLabel* const told = about.find_label(label);
    json["labels"].back()["colour"] =
        told != nullptr && told->colour ? io::to_text(*told->colour) : std::string();
    json["labels"].back()["id"] = told != nullptr ? told->id : std::string();
    json["labels"].back()["kind"] = told != nullptr ? told->kind : std::string();
    const auto volume = summary.volumes.find(label);
    const bool has_volume = volume != summary.volumes.end() && volume->second.problem.empty();
    json["labels"].back()["volume"] = has_volume ? Json(volume->second.surface) : Json();
    json["labels"].back()["slab_volume"] = has_volume ? Json(volume->second.slabs) : Json();
  }
  json["notes"] = about.notes;
  return json;
}

void print_size(const StackSize& size) {
  std::cout << counted(size.slices, "slice") << ", " << counted(size.contours, "contour") << ", "
            << grouped(size.vertices) << " vertices";
}

void print_about(const Stack& about) {
  std::string line;
  const auto add = [&](const std::string& text) { line += (line.empty() ? "  " : ", ") + text; };
  if (!about.unit.empty()) add("unit " + about.unit);
  if (about.fill) add(std::string("fill ") + name(*about.fill));
  if (about.frame) add("slices are tilted: coordinates are those of the world");
  if (!line.empty()) std::cout << line << '\n';
  for (const std::string& note : about.notes) std::cout << "  " << note << '\n';
}

std::string volume_of(const StackSummary& summary, const std::string& label) {
  const auto found = summary.volumes.find(label);
  return found == summary.volumes.end() ? "" : describe(found->second, summary.about.unit);
}

/// A line each; of many the names alone.
void print_labels(const StackSummary& summary) {
  if (summary.labels.size() == 1 && summary.labels.begin()->first.empty()) {
    if (const std::string volume = volume_of(summary, ""); !volume.empty())
      std::cout << "  " << volume << '\n';
    return;
  }
  if (summary.labels.size() > most_lines) {
    std::cout << "  " << grouped(summary.labels.size()) << " labels (all with --json): ";
    const char* between = "";
    for (const auto& [label, size] : summary.labels)
      std::cout << std::exchange(between, ", ") << label;
    std::cout << '\n';
    return;
  }
  for (const auto& [label, size] : summary.labels) {
    std::cout << "  label '" << label << "': ";
    print_size(size);
    if (const std::string volume = volume_of(summary, label); !volume.empty())
      std::cout << ", " << volume;
    if (const StackLabel* const told = summary.about.find_label(label)) {
      if (told->colour) std::cout << ", " << io::to_text(*told->colour);
      if (!told->id.empty()) std::cout << ", id " << told->id;
      if (!told->kind.empty()) std::cout << ", " << told->kind;
    }
    std::cout << '\n';
  }
}

void print_stack(const StackSummary& summary) {
  std::cout << "  ";
  print_size(summary.size);
  if (summary.empty_slices > 0)
    std::cout << ", " << counted(summary.empty_slices, "slice") << " empty";
  std::cout << '\n';
  print_bounds(summary.bounds);
  if (const std::vector<double>& gaps = summary.gaps; !gaps.empty()) {
    std::cout << "  gaps between slices " << rounded(gaps.front()) << " to " << rounded(gaps.back())
              << ", median " << rounded(gaps[gaps.size() / 2]) << '\n';
  }
  print_about(summary.about);
  print_labels(summary);
}

struct MeshSummary {
  std::string label;
  Measures measures;
  Bounds bounds;
};

std::vector<MeshSummary> summarise(const std::vector<io::LabelledMesh>& meshes) {
  std::vector<MeshSummary> summaries;
  for (const auto& [label, mesh, colour] : meshes) {
    MeshSummary summary{label, measure(mesh), {}};
    for (const Vec3& point : mesh.points) summary.bounds.add(point);
    summaries.push_back(std::move(summary));
  }
  return summaries;
}

/// `loft info MESH --json`: schema "loft-info", schema_version 1, file, kind "mesh", parts (label,
/// counts and measures, bounds).
Json to_json(const std::vector<MeshSummary>& summaries) {
  Json json;
  json["kind"] = "mesh";
  json["parts"] = Json::array();
  for (const MeshSummary& summary : summaries) {
    Json part;
    part["label"] = summary.label;
    add_measures(part, summary.measures);
    add_angles(part, summary.measures.angles);
    part["bounds"] = to_json(summary.bounds);
    json["parts"].push_back(std::move(part));
  }
  return json;
}

void print_meshes(const std::vector<MeshSummary>& summaries) {
  for (const auto& [label, measures, bounds] : summaries) {
    std::cout << "  " << (label.empty() ? "" : "label '" + label + "': ") << describe(measures, "")
              << "\n  " << describe(measures.angles) << '\n';
    print_bounds(bounds);
  }
}

}  // namespace

ExitCode run(const InfoCommand& command) {
  EachFile each("loft-info", "file", command.json);
  return each.run(command.files, [&](const std::filesystem::path& file, Json& json) {
    const auto show = [&](const auto& summary, const auto& print_summary) {
      if (command.json) return json.update(to_json(summary));
      std::cout << file.string() << '\n';
      print_summary(summary);
    };
    if (io::is_stack_file(file)) {
      show(summarise(io::read_stack(file, command.read), command), print_stack);
    } else if (io::is_mesh_file(file)) {
      show(summarise(io::read_meshes(file)), print_meshes);
    } else {
      throw io::UnknownFormat(file, io::stack_extensions() + ' ' + io::mesh_extensions());
    }
    return ExitCode::ok;
  });
}

}  // namespace loft::app
