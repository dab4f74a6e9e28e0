// SPDX-License-Identifier: MIT
#include "mesh/check.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/each_file.h"
#include "app/commands/fidelity.h"
#include "app/json.h"
#include "app/report.h"
#include "app/terminal.h"
#include "io/meshes.h"
#include "io/stack.h"
#include "mesh/measure.h"

namespace loft::app {

namespace {

/// What one mesh of the file is worth.
struct Verdict {
  std::string label;
  Measures measures;
  Contacts contacts;
  std::map<Fault, std::vector<Finding>> faults;
  bool has_more = false;  ///< faces may meet elsewhere, too; check() has stopped
};

std::vector<Verdict> judge(const std::vector<io::LabelledMesh>& meshes) {
  std::vector<Verdict> verdicts;
  for (const auto& [label, mesh, colour] : meshes) {
    Verdict verdict{label, measure(mesh), contacts(mesh), {}};
    for (Finding& finding : check(mesh))
      verdict.faults[finding.fault].push_back(std::move(finding));
    const auto meeting = verdict.faults.find(Fault::self_intersection);
    verdict.has_more =
        meeting != verdict.faults.end() && meeting->second.size() >= most_intersections(mesh);
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

/// ` faces 3 7 vertices 1 2`, of one finding.
std::string where(const Finding& finding) {
  constexpr std::size_t shown = 8;  // an edge may have thousands of faces
  std::string text;
  const auto add = [&](const char* what, const std::vector<std::uint32_t>& numbers) {
    if (numbers.empty()) return;
    text += what;
    for (std::size_t i = 0; i < std::min(shown, numbers.size()); ++i)
      text += ' ' + std::to_string(numbers[i]);
    if (numbers.size() > shown) text += " and " + grouped(numbers.size() - shown) + " more";
  };
  add(" faces", finding.faces);
  add(" vertices", finding.vertices);
  return text;
}

/// Touching is no fault.
void print_contacts(const Contacts& contacts) {
  if (contacts.points == 0) return;
  std::cout << "  touches itself in " << grouped(contacts.points) << " points and "
            << grouped(contacts.edges) << " edges, which is allowed; first at ("
            << contacts.first[0] << ", " << contacts.first[1] << ", " << contacts.first[2] << ")\n";
}

void print_verdict(const std::string& name, const Verdict& verdict) {
  std::cout << name << (verdict.label.empty() ? "" : " '" + verdict.label + "'")
            << (verdict.faults.empty() ? ": a valid solid\n" : ": not a valid solid\n");
  std::cout << "  " << describe(verdict.measures, "") << '\n';
  print_contacts(verdict.contacts);
  for (const auto& [fault, findings] : verdict.faults) {
    const bool has_more = verdict.has_more && fault == Fault::self_intersection;
    std::cout << "  " << loft::name(fault) << ": " << grouped(findings.size())
              << (has_more ? " or more" : "") << (has_more ? ", one at" : ", first at")
              << where(findings.front()) << '\n';
  }
}

void print_fidelity(const CheckCommand& command, const Fidelity& fidelity, bool is_exact_format) {
  const std::string name = command.stack->string();
  if (fidelity.is_complete()) {
    std::cout << name << ": all " << grouped(fidelity.vertices) << " contour vertices and "
              << grouped(fidelity.edges) << " contour edges are in the mesh, "
              << (command.within > 0 ? "within " + rounded(command.within) : "exactly") << '\n';
    return;
  }
  std::cout << name << ": not in the mesh: " << grouped(fidelity.missing_vertices) << " of "
            << grouped(fidelity.vertices) << " contour vertices, "
            << grouped(fidelity.missing_edges) << " of " << grouped(fidelity.edges)
            << " contour edges; first: " << *fidelity.first_missing << '\n';
  if (!is_exact_format) {
    std::cout << "  STL and glTF round coordinates to float; compare a .ply, .obj or .off\n";
  }
}

/// The object that `loft check --json` prints: schema "loft-check", schema_version 1, mesh, valid,
/// parts (label, valid, counts and measures, touching: points and edges, faults by name), stack
/// (name, within, counts); of faults of which there may be more, more_faults is true. Faces that
/// cross are the fault self_intersection; touching is none.
void add_verdicts(Json& json, const CheckCommand& command, const std::vector<Verdict>& verdicts,
                  const std::optional<Fidelity>& fidelity) {
  json["valid"] = std::ranges::all_of(verdicts, [](const Verdict& v) { return v.faults.empty(); });
  json["parts"] = Json::array();
  for (const Verdict& verdict : verdicts) {
    Json part;
    part["label"] = verdict.label;
    part["valid"] = verdict.faults.empty();
    add_measures(part, verdict.measures);
    part["touching"] = {{"points", verdict.contacts.points}, {"edges", verdict.contacts.edges}};
    part["faults"] = Json::object();
    for (const auto& [fault, findings] : verdict.faults) {
      part["faults"][loft::name(fault)] = findings.size();
    }
    if (verdict.has_more) part["more_faults"] = true;
    json["parts"].push_back(std::move(part));
  }
  if (!fidelity) return;
  json["stack"] = {{"name", command.stack->string()},
                   {"within", command.within},
                   {"complete", fidelity->is_complete()},
                   {"vertices", fidelity->vertices},
                   {"missing_vertices", fidelity->missing_vertices},
                   {"edges", fidelity->edges},
                   {"missing_edges", fidelity->missing_edges}};
}

}  // namespace

namespace {

ExitCode check_file(const CheckCommand& command, const std::filesystem::path& file,
                    const Stack& stack, Json& json) {
  const std::vector<io::LabelledMesh> meshes = io::read_meshes(file);
  std::optional<Fidelity> fidelity;
  if (command.stack) fidelity = compare(stack, meshes, command.within);
  const std::vector<Verdict> verdicts = judge(meshes);

  if (command.json) {
    add_verdicts(json, command, verdicts, fidelity);
  } else {
    for (const Verdict& verdict : verdicts) print_verdict(file.string(), verdict);
    if (fidelity) {
      print_fidelity(command, *fidelity, io::keeps_coordinates(file));
    }
  }
  const bool is_valid =
      std::ranges::all_of(verdicts, [](const Verdict& v) { return v.faults.empty(); });
  const bool is_good = is_valid && (!fidelity || fidelity->is_complete());
  return is_good ? ExitCode::ok : ExitCode::check_failed;
}

}  // namespace

ExitCode run(const CheckCommand& command) {
  Stack stack;
  if (command.stack) stack = io::read_stack(*command.stack, command.read);
  EachFile each("loft-check", "mesh", command.json);
  return each.run(command.meshes, [&](const std::filesystem::path& file, Json& json) {
    return check_file(command, file, stack, json);
  });
}

}  // namespace loft::app
