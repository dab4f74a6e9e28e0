// SPDX-License-Identifier: MIT
#include "app/commands/path_outputs.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/planar/path_points.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

using paths::Status;

std::string word_of(Status status) { return std::string(name_of(status)); }

/// `null` where there is no path.
std::string length_text(const paths::Path& path, const char* nothing) {
  return path.status == Status::found ? exact(path.length) : nothing;
}

std::string points_cell(const FoundPath& found) {
  std::string cell;
  for (const cdt::Point& p : io::points_along(found.path, found.asked.from)) {
    if (!cell.empty()) cell += ';';
    append_number(cell, p.x);
    cell += ' ';
    append_number(cell, p.y);
  }
  return cell;
}

/// A line has two points, even where start and goal are one place.
std::vector<cdt::Point> line_of(const FoundPath& found) {
  std::vector<cdt::Point> line = io::points_along(found.path, found.asked.from);
  if (line.size() == 1) line.push_back(found.asked.to);
  return line;
}

}  // namespace

Json count_by_status(std::span<const FoundPath> paths) {
  Json counts = Json::object();
  for (const Status status : {Status::found, Status::unreachable, Status::start_blocked,
                              Status::goal_blocked, Status::gave_up}) {
    std::size_t count = 0;
    for (const FoundPath& one : paths) count += one.path.status == status ? 1U : 0U;
    if (count > 0) counts[word_of(status)] = count;
  }
  return counts;
}

std::string table_of(std::span<const FoundPath> paths) {
  std::string table = "query,edit,status,radius,length,points\r\n";
  for (const FoundPath& one : paths)
    table += std::to_string(one.query) + ',' + std::to_string(one.edit) + ',' +
             word_of(one.path.status) + ',' + exact(one.asked.radius) + ',' +
             length_text(one.path, "") + ',' + points_cell(one) + "\r\n";
  return table;
}

io::Map map_of(std::span<const FoundPath> paths) {
  io::Map map;
  for (const FoundPath& one : paths) {
    io::Feature& feature = map.features.emplace_back();
    feature.properties = "{\"query\":" + std::to_string(one.query) +
                         ",\"edit\":" + std::to_string(one.edit) + ",\"status\":\"" +
                         word_of(one.path.status) + "\",\"radius\":" + exact(one.asked.radius) +
                         ",\"length\":" + length_text(one.path, "null") + '}';
    if (auto line = line_of(one); !line.empty()) feature.lines.push_back(std::move(line));
  }
  return map;
}

void draw(io::PathPicture& picture, std::span<const FoundPath> paths) {
  for (const FoundPath& one : paths)
    picture.paths.push_back({.query = one.asked,
                             .path = one.path,
                             .hue = one.query,
                             .is_faint = one.edit != paths.back().edit});
}

Json report_of(std::span<const FoundPath> paths) {
  Json report = Json::array();
  for (const FoundPath& one : paths) {
    Json entry{
        {"query", one.query},         {"edit", one.edit},  {"status", word_of(one.path.status)},
        {"radius", one.asked.radius}, {"length", nullptr}, {"expansions", one.expansions}};
    if (one.path.status == Status::found) entry["length"] = one.path.length;
    report.push_back(std::move(entry));
  }
  return report;
}

}  // namespace loft::app
