// SPDX-License-Identifier: MIT
#include "io/precomputed.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/json_reader.h"
#include "io/rounding/rounded_parts.h"

namespace loft::io {

namespace {

using std::filesystem::path;

void make_folder(const path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error && !std::filesystem::is_directory(folder))
    throw FileError(Access::write, folder, error.message());
}

void write_text(const path& file, const std::string& text) {
  AtomicFile whole(file);
  whole.stream() << text;
  whole.commit();
}

/// Not where it is so already: a hundred jobs say the same.
void ensure_text(const path& file, const std::string& text) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) && read_file(file) == text) return;
  write_text(file, text);
}

/// Whether an `info` says that its folder is one of meshes.
bool is_of_meshes(const path& info) {
  return read_file(info).find("neuroglancer_legacy_mesh") != std::string::npos;
}

/// A JSON file that is looked into.
class JsonFile {
 public:
  explicit JsonFile(path file) : file_(std::move(file)), text_(read_file(file_)) {}

  /// The strings of the list that members lead to, one inside the other; `0` is the first of a
  /// list. None where there is no such list. Throws InputError.
  [[nodiscard]] std::vector<std::string> strings(std::span<const std::string_view> members) const {
    try {
      JsonReader json(text_, "file");
      for (const std::string_view member : members)
        if (!(member == "0" ? enter_first(json) : enter(json, member))) return {};
      return strings(json);
    } catch (const JsonError& error) {
      throw InputError(file_.string() + ": " + error.what());
    }
  }

 private:
  static bool enter(JsonReader& json, std::string_view member) {
    if (json.peek() != JsonKind::object) return false;
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == member) return true;
      json.skip();
    }
    return false;
  }
  static bool enter_first(JsonReader& json) {
    if (json.peek() != JsonKind::list) return false;
    json.begin_list();
    return json.next_item();
  }
  [[nodiscard]] std::vector<std::string> strings(JsonReader& json) const {
    std::vector<std::string> result;
    if (json.peek() != JsonKind::list) return result;
    json.begin_list();
    while (json.next_item()) {
      if (json.peek() != JsonKind::string)
        throw InputError(file_.string() + ": a name that is no string");
      result.push_back(json.string());
    }
    return result;
  }

  path file_;
  std::string text_;
};

/// The names of segments, by their numbers as text; none where there is no such file.
std::map<std::string, std::string> segment_names(const path& folder) {
  const path file = folder / neuroglancer::properties_folder / "info";
  std::error_code ignored;
  std::map<std::string, std::string> names;
  if (!std::filesystem::is_regular_file(file, ignored)) return names;
  const JsonFile json(file);
  const auto ids = json.strings(std::array<std::string_view, 2>{"inline", "ids"});
  const auto labels =
      json.strings(std::array<std::string_view, 4>{"inline", "properties", "0", "values"});
  for (std::size_t i = 0; i < std::min(ids.size(), labels.size()); ++i) names[ids[i]] = labels[i];
  return names;
}

/// The numbers of segments that have a manifest, in order.
std::vector<std::uint64_t> segments_in(const path& folder) {
  std::vector<std::uint64_t> ids;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t id = 0;
    const char* const end = name.data() + name.size();
    const auto [stop, fault] = std::from_chars(name.data(), end, id);
    if (fault == std::errc() && std::string_view(stop, end) == ":0") ids.push_back(id);
  }
  if (error) throw FileError(Access::read, folder, error.message());
  std::ranges::sort(ids);
  return ids;
}

void append(Mesh& mesh, const Mesh& more) {
  if (mesh.points.size() + more.points.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError("a segment's fragments have more vertices than can be numbered");
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  for (const auto& [a, b, c] : more.faces) mesh.faces.push_back({first + a, first + b, first + c});
}

Mesh read_segment(const path& folder, std::uint64_t id) {
  const path file = folder / neuroglancer::manifest_name(id);
  Mesh mesh;
  std::set<std::string> seen;
  for (const std::string& name :
       JsonFile(file).strings(std::array<std::string_view, 1>{"fragments"})) {
    if (!seen.insert(name).second)
      throw InputError(file.string() + ": it names the fragment " + name + " twice");
    if (path(name).filename() != name)
      throw InputError(file.string() + ": a fragment outside of its folder");
    append(mesh, read_fragment(read_file(folder / name), (folder / name).string()));
  }
  if (mesh.faces.empty()) throw InputError(file.string() + ": it names no fragments");
  return mesh;
}

}  // namespace

std::optional<path> precomputed_folder(const path& output) {
  constexpr std::string_view scheme = "precomputed://";
  const std::string text = output.string();
  if (!text.starts_with(scheme)) return {};
  return text.substr(scheme.size());
}

Precomputed::Precomputed(path folder, std::vector<Segment> segments)
    : folder_(std::move(folder)), segments_(std::move(segments)) {
  std::ranges::sort(segments_, {}, &Segment::label);
}

std::uint64_t Precomputed::id_of(const std::string& label) const {
  return std::ranges::lower_bound(segments_, label, {}, &Segment::label)->id;
}

void Precomputed::require_own() const {
  std::error_code ignored;
  const path info = folder_ / "info";
  if (std::filesystem::is_regular_file(info, ignored) && !is_of_meshes(info))
    throw FileError(Access::write, info,
                    "it describes something else than meshes of Neuroglancer; take another folder");
  std::map<std::string, std::string> ours;
  for (const Segment& segment : segments_) ours[std::to_string(segment.id)] = segment.label;
  for (const auto& [id, name] : segment_names(folder_)) {
    const auto found = ours.find(id);
    if (found == ours.end() || found->second != name)
      throw FileError(Access::write, folder_,
                      "it has the meshes of another stack: segment " + id + " is '" + name +
                          "' there; take another folder, or remove it");
  }
}

void Precomputed::begin() const {
  require_own();
  const path names = folder_ / neuroglancer::properties_folder;
  make_folder(names);
  ensure_text(names / "info", neuroglancer::properties(segments_));
  ensure_text(folder_ / "info", neuroglancer::info());
}

bool Precomputed::has(const std::string& label) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder_ / neuroglancer::manifest_name(id_of(label)),
                                          ignored);
}

Written Precomputed::write(const Part& part, double metres_per_unit) const {
  const std::uint64_t id = id_of(part.label);
  const RoundedParts rounded({&part, 1}, {{}, nanometres(metres_per_unit)}, false);
  AtomicFile fragment(folder_ / neuroglancer::fragment_name(id));
  write_fragment(fragment.stream(), rounded.parts().front(), metres_per_unit);
  fragment.commit();
  write_text(folder_ / neuroglancer::manifest_name(id), neuroglancer::manifest(id));
  return {rounded.rounding()};
}

std::vector<LabelledMesh> read_precomputed(const path& folder) {
  const std::map<std::string, std::string> names = segment_names(folder);
  std::vector<LabelledMesh> meshes;
  for (const std::uint64_t id : segments_in(folder)) {
    const auto name = names.find(std::to_string(id));
    meshes.push_back(
        {name == names.end() ? std::to_string(id) : name->second, read_segment(folder, id)});
  }
  if (meshes.empty()) throw InputError(folder.string() + ": no mesh of Neuroglancer is in it");
  return meshes;
}

}  // namespace loft::io
