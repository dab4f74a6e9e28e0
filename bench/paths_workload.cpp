// SPDX-License-Identifier: MIT
// Times loft::paths on meshes and queries of the MovingAI kind, and obstacles that move.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/measure.h"
#include "overlay/overlay.h"
#include "paths/channel.h"
#include "paths/funnel.h"
#include "paths/shortest.h"

namespace loft::bench {
namespace {

using cdt::Point;
using overlay::Expression;
using overlay::LayerId;
using overlay::Overlay;
using overlay::Ring;
using paths::FreeSpace;
using paths::Path;
using paths::Query;
using paths::Status;

constexpr const char* usage =
    "usage: paths_workload queries MESH SCEN REF      shortest paths, and channels pulled taut\n"
    "       paths_workload unreachable MESH SCEN      goals that no way leads to\n"
    "       paths_workload move OBSTACLES STEPS [gaps]   one of so many is somewhere else\n";

std::ifstream open_file(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("cannot read " + name);
  return file;
}

/// The border of a mesh of polygons: `mesh`, a version, the numbers of vertices and polygons; for
/// each vertex x, y, and a list of polygons; for each polygon the list of its corners, then of its
/// neighbours, each across the side that ends in the corner, -1 where there is none.
std::vector<Ring> read_border(const std::string& name) {
  std::ifstream file = open_file(name);
  std::string word;
  std::size_t version = 0;
  std::size_t vertices = 0;
  std::size_t polygons = 0;
  file >> word >> version >> vertices >> polygons;
  const auto read_list = [&](std::size_t count) {
    std::vector<long> list(count);
    for (long& number : list) file >> number;
    return list;
  };
  const auto read_count = [&] {
    std::size_t count = 0;
    file >> count;
    return count;
  };
  std::vector<Point> points(vertices);
  for (Point& p : points) {
    file >> p.x >> p.y;
    (void)read_list(read_count());
  }
  std::multimap<long, long> sides;
  for (std::size_t i = 0; i < polygons; ++i) {
    const std::size_t count = read_count();
    const std::vector<long> corners = read_list(count);
    const std::vector<long> neighbours = read_list(count);
    for (std::size_t k = 0; k < count; ++k)
      if (neighbours[k] < 0) sides.emplace(corners[(k + count - 1) % count], corners[k]);
  }
  if (!file) throw std::runtime_error(name + " is no mesh");
  std::vector<Ring> rings;
  while (!sides.empty()) {
    Ring& ring = rings.emplace_back();
    const long start = sides.begin()->first;
    long at = start;
    do {
      const auto side = sides.find(at);
      if (side == sides.end()) throw std::runtime_error(name + " has a border with an end");
      ring.push_back(points.at(static_cast<std::size_t>(at)));
      at = side->second;
      sides.erase(side);
    } while (at != start);
  }
  return rings;
}

/// A line for each: bucket, map, width, height, start, goal and a length on the grid.
std::vector<Query> read_queries(const std::string& name) {
  std::ifstream file = open_file(name);
  std::string line;
  std::getline(file, line);
  std::vector<Query> queries;
  std::string bucket;
  std::string map;
  double width = 0;
  double height = 0;
  double length = 0;
  Query query{};
  while (file >> bucket >> map >> width >> height >> query.from.x >> query.from.y >> query.to.x >>
         query.to.y >> length)
    queries.push_back(query);
  return queries;
}

std::vector<double> read_lengths(const std::string& name) {
  std::ifstream file = open_file(name);
  std::vector<double> lengths;
  for (double length = 0; file >> length;) lengths.push_back(length);
  return lengths;
}

/// What is inside of rings.
struct Map {
  Overlay overlay;
  LayerId layer = overlay.add_layer("free", overlay::FillRule::nonzero);

  explicit Map(std::span<const Ring> rings) {
    std::vector<overlay::Shape> shapes;
    for (const Ring& ring : rings) shapes.push_back({layer, ring});
    overlay.insert(shapes);
  }
};

/// Times of queries, and how long paths are, compared with the shortest.
class Tally {
 public:
  void add(double seconds) {
    durations_.add(seconds);
    sum_ += seconds;
    ++count_;
  }
  void add(const Path& path, double shortest) {
    if (path.status != Status::found) {
      ++lost_;
      return;
    }
    const double ratio = shortest > 0 ? path.length / shortest : 1 + path.length;
    worst_ = std::max(worst_, std::abs(ratio - 1));
    ratios_ += ratio;
    ++compared_;
    longer_ += ratio > 1.001 ? 1 : 0;
  }
  void print(const char* what) const {
    std::printf(
        "%s median=%.2f mean=%.2f p99=%.2f us; ratio=%.6f worst=%.3g longer=%zu of %zu, none=%zu\n",
        what, durations_.microseconds(0.5), 1e6 * sum_ / static_cast<double>(count_),
        durations_.microseconds(0.99), ratios_ / static_cast<double>(compared_), worst_, longer_,
        compared_, lost_);
  }

 private:
  Durations durations_;
  double sum_ = 0;
  std::size_t count_ = 0;
  double worst_ = 0;
  double ratios_ = 0;
  std::size_t compared_ = 0;
  std::size_t longer_ = 0;
  std::size_t lost_ = 0;
};

void time_queries(const Arguments& arguments) {
  Map map(read_border(arguments.word(1)));
  const std::vector<Query> queries = read_queries(arguments.word(2));
  const std::vector<double> lengths = read_lengths(arguments.word(3));
  if (lengths.size() != queries.size()) throw std::runtime_error("not a length a query");
  const double built = seconds_of([&] { const FreeSpace space(map.overlay, map.layer); });
  const FreeSpace space(map.overlay, map.layer);
  std::printf("map triangles=%zu space=%.2f ms\n", space.mesh().triangle_count(), 1e3 * built);

  paths::Workspace workspace;
  paths::ChannelSearch search;
  paths::Funnel funnel;
  paths::Channel channel;
  Path path;
  Tally shortest;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    shortest.add(seconds_of([&] { workspace.find(space, queries[i], path); }));
    shortest.add(path, lengths[i]);
  }
  shortest.print("shortest");
  Tally taut;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    taut.add(seconds_of([&] {
      search.find(space, queries[i].from, queries[i].to, channel);
      funnel.pull(channel, path);
    }));
    taut.add(path, lengths[i]);
  }
  taut.print("channel");
}

/// Each goal is in a box of its own beside the map. Times are per point that is located.
void time_unreachable(const Arguments& arguments) {
  std::vector<Ring> rings = read_border(arguments.word(1));
  cdt::Box bounds;
  for (const Ring& ring : rings)
    for (const Point p : ring) bounds.add(p);
  const double x = bounds.high.x + 1;
  const double y = bounds.low.y;
  rings.push_back({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
  Map map(rings);
  const FreeSpace space(map.overlay, map.layer);
  std::vector<Query> queries = read_queries(arguments.word(2));
  for (Query& query : queries) query.to = {x + 0.5, y + 0.5};

  paths::Workspace workspace;
  Path path;
  std::size_t known = 0;
  const auto find_all = [&] {
    for (const Query& query : queries) {
      workspace.find(space, query, path);
      known += path.status == Status::unreachable ? 1 : 0;
    }
  };
  std::size_t located = 0;
  const auto locate_all = [&] {
    for (const Query& query : queries) {
      located += space.mesh().locate(query.from).edge.is_none() ? 0U : 1U;
      located += space.mesh().locate(query.to).edge.is_none() ? 0U : 1U;
    }
  };
  find_all();
  locate_all();
  const double finding = seconds_of(find_all) / static_cast<double>(queries.size());
  const double locating = seconds_of(locate_all) / static_cast<double>(2 * queries.size());
  std::printf("unreachable mean=%.4f us, locate=%.4f us, times=%.2f; %zu of %zu\n", 1e6 * finding,
              1e6 * locating, finding / locating, known / 2, located / 4);
}

/// Boxes of 4 to 8 corners, turned as they come, in a room in which they leave about half free.
class Boxes {
 public:
  explicit Boxes(std::size_t count) : size_(std::sqrt(static_cast<double>(count)) * 20) {}

  [[nodiscard]] Ring room() const { return {{0, 0}, {size_, 0}, {size_, size_}, {0, size_}}; }
  [[nodiscard]] Ring next() {
    const Point centre{number() * size_, number() * size_};
    const double radius = 4 + 6 * number();
    const double turn = 2 * std::numbers::pi * number();
    const std::size_t corners = 4 + static_cast<std::size_t>(5 * number());
    Ring ring;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle =
          turn + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return ring;
  }
  [[nodiscard]] Point step() { return {4 * number() - 2, 4 * number() - 2}; }
  [[nodiscard]] std::size_t index(std::size_t bound) { return random_() % bound; }

 private:
  [[nodiscard]] double number() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::mt19937_64 random_{1};
  double size_;
};

void time_moves(const Arguments& arguments) {
  const auto count = arguments.number<std::size_t>(1);
  const auto steps = arguments.number<std::size_t>(2);
  Boxes boxes(count);
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId obstacles = overlay.add_layer("obstacles", overlay::FillRule::nonzero);
  overlay.insert(room, boxes.room());
  std::vector<overlay::RingId> rings;
  for (std::size_t i = 0; i < count; ++i) rings.push_back(overlay.insert(obstacles, boxes.next()));
  FreeSpace space(overlay, Expression(room) - obstacles);
  const bool has_gaps = arguments.word_or(3, "") == "gaps";
  if (has_gaps) space.keep_gaps();
  Durations edits;
  Durations follows;
  Durations all;
  const auto time = [&](const auto& edit) {
    const double editing = seconds_of(edit);
    const double following = seconds_of([&] { space.follow(); });
    edits.add(editing);
    follows.add(following);
    all.add(editing + following);
  };
  const auto print = [&](const char* what) {
    std::printf("%s median=%.2f p99=%.2f us; edit %.2f and %.2f, follow %.2f and %.2f\n", what,
                all.microseconds(0.5), all.microseconds(0.99), edits.microseconds(0.5),
                edits.microseconds(0.99), follows.microseconds(0.5), follows.microseconds(0.99));
    edits = follows = all = Durations();
  };
  for (std::size_t i = 0; i < steps; ++i)
    time([&] { overlay.translate(rings[boxes.index(count)], boxes.step()); });
  print("step");
  for (std::size_t i = 0; i < steps; ++i)
    time([&, ring = boxes.next()] { overlay.move(rings[boxes.index(count)], ring); });
  print("jump");
}

void run(const Arguments& arguments) {
  const std::string mode = arguments.word(0);
  if (mode == "queries") return time_queries(arguments);
  if (mode == "unreachable") return time_unreachable(arguments);
  if (mode == "move") return time_moves(arguments);
  throw std::invalid_argument(usage);
}

}  // namespace
}  // namespace loft::bench

int main(int argc, char** argv) {
  try {
    loft::bench::run({argc, argv, loft::bench::usage});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
