// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_load.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "io/bytes/json_reader.h"
#include "io/bytes/text.h"
#include "io/gltf/glb_chunks.h"
#include "io/gltf/packed.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::size_t deepest = 100;
constexpr std::uint64_t most_bytes = std::numeric_limits<unsigned>::max();

/// The largest number of brackets that are open at one place. Brackets in strings do not count.
std::size_t nesting(std::string_view json) {
  std::size_t depth = 0;
  std::size_t most = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (is_string) {
      if (c == '\\') ++i;
      if (c == '"') is_string = false;
    } else if (c == '"') {
      is_string = true;
    } else if (c == '{' || c == '[') {
      most = std::max(most, ++depth);
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return most;
}

// --- Files beside it ---

/// What a `uri` percent-encodes.
std::string decoded(std::string_view uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
  };
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    result += is_code ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return result;
}

/// A regular file that lies in the folder itself, wherever links on the way may lead.
std::optional<std::uint64_t> size_in_folder(const std::filesystem::path& file,
                                            const std::filesystem::path& folder) {
  std::error_code error;
  const auto place = std::filesystem::canonical(file, error);
  if (error) return {};
  const auto home = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  if (error || place.parent_path() != home) return {};
  if (!std::filesystem::is_regular_file(place, error) || error) return {};
  const auto size = std::filesystem::file_size(place, error);
  if (error) return {};
  return size;
}

/// What tinygltf may do with files; `folder` is a path.
bool exists_in_folder(const std::string& file, void* folder) {
  return size_in_folder(file, *static_cast<const std::filesystem::path*>(folder)).has_value();
}

std::string as_it_is(const std::string& path, void*) { return path; }

/// Opens without waiting and looks again at what it has opened: the name may mean something else by
/// now.
bool read_in_folder(std::vector<unsigned char>* bytes, std::string* error, const std::string& file,
                    void* folder) {
  *error = "it cannot be read";
  if (!exists_in_folder(file, folder)) return false;
  const int opened = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return false;
  struct stat status {};
  bool is_read = ::fstat(opened, &status) == 0 && S_ISREG(status.st_mode) &&
                 static_cast<std::uint64_t>(status.st_size) <= most_bytes;
  if (is_read) bytes->resize(static_cast<std::size_t>(status.st_size));
  for (std::size_t done = 0; is_read && done < bytes->size();) {
    const auto count = ::read(opened, bytes->data() + done, bytes->size() - done);
    is_read = count > 0;
    if (is_read) done += static_cast<std::size_t>(count);
  }
  ::close(opened);
  return is_read;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

/// No image is left in what tinygltf reads.
bool ignore_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                  int, void*) {
  return true;
}

// --- The text ---

class Filter {
 public:
  Filter(std::string_view json, const std::filesystem::path& folder, std::string_view name)
      : text_(json), folder_(folder), name_(name) {}

  /// The text with the members about shapes alone, its buffers looked at.
  std::string run() {
    if (nesting(text_) > deepest)
      fail("brackets are nested more than " + std::to_string(deepest) + " deep");
    try {
      return filtered();
    } catch (const JsonError& error) {
      fail("not glTF: broken JSON at byte " + std::to_string(error.column()) + ": " + error.what());
    }
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(std::string(name_) + ": " + message);
  }

  std::string filtered() {
    constexpr std::array<std::string_view, 9> kept{"asset",       "scene",   "scenes",
                                                   "nodes",       "meshes",  "accessors",
                                                   "bufferViews", "buffers", "materials"};
    JsonReader json(text_, "text");
    if (json.peek() != JsonKind::object) fail("not glTF: " + reject(json, "an object"));
    std::string result = "{";
    json.begin_object();
    while (const auto key = json.next_key()) {
      const bool is_kept = std::ranges::find(kept, *key) != kept.end();
      const std::string value = *key == "buffers"     ? buffers(json)
                                : *key == "materials" ? materials(json)
                                                      : std::string(json.text());
      if (!is_kept) continue;
      if (result.size() > 1) result += ',';
      append_json_string(result, *key);
      result += ':';
      result += value;
    }
    json.end();
    return result + '}';
  }

  /// The list, looked at. A buffer that is only there for who cannot unpack others has no bytes.
  std::string buffers(JsonReader& json) {
    constexpr const char* no_bytes =
        R"({"byteLength":1,"uri":"data:application/octet-stream;base64,AA=="})";
    if (json.peek() != JsonKind::list) fail("not glTF: \"buffers\": " + reject(json, "a list"));
    json.begin_list();
    std::uint64_t total = 0;
    std::size_t inside = 0;
    std::string result = "[";
    for (std::size_t i = 0; json.next_item(); ++i) {
      if (json.peek() != JsonKind::object) fail("not glTF: " + reject(json, "a buffer"));
      const std::string_view text = json.text();
      const auto [uri, is_fallback] = members_of(text);
      if (!uri && !is_fallback && ++inside > 1) fail("more than one buffer without \"uri\"");
      if (uri && !uri->starts_with("data:")) total += size_of(*uri, i);
      if (total > most_bytes) fail("its buffers are larger than 4 GiB");
      if (i > 0) result += ',';
      result += is_fallback && !uri ? no_bytes : text;
    }
    return result + ']';
  }

  /// The list, with nothing but colours: what else there may be is no part of a shape.
  static std::string materials(JsonReader& json) {
    if (json.peek() != JsonKind::list) {
      json.skip();
      return "[]";
    }
    json.begin_list();
    std::string result = "[";
    for (bool is_first = true; json.next_item(); is_first = false) {
      if (!is_first) result += ',';
      const auto metallic = member_of(json.text(), "pbrMetallicRoughness");
      const auto factor = metallic ? member_of(*metallic, "baseColorFactor") : std::nullopt;
      result += factor && are_shares(*factor) ? R"({"pbrMetallicRoughness":{"baseColorFactor":)" +
                                                    compact_json(*factor) + "}}"
                                              : "{}";
    }
    return result + ']';
  }

  /// As it is written; none in what is no object.
  static std::optional<std::string_view> member_of(std::string_view text, std::string_view wanted) {
    JsonReader json(text);
    std::optional<std::string_view> found;
    if (json.peek() != JsonKind::object) return {};
    json.begin_object();
    while (const auto key = json.next_key()) {
      const std::string_view value = json.text();
      if (*key == wanted) found = value;
    }
    return found;
  }

  /// Whether it is a list of four numbers.
  static bool are_shares(std::string_view text) {
    JsonReader json(text);
    if (json.peek() != JsonKind::list) return false;
    json.begin_list();
    std::size_t count = 0;
    for (; json.next_item(); ++count) {
      if (json.peek() != JsonKind::number) return false;
      json.skip();
    }
    return count == 4;
  }

  struct BufferMembers {
    std::optional<std::string> uri;
    bool is_fallback = false;
  };

  static BufferMembers members_of(std::string_view buffer) {
    BufferMembers members;
    JsonReader json(buffer);
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == "uri" && json.peek() == JsonKind::string) {
        members.uri = json.string();
      } else if (*key == "extensions") {
        members.is_fallback =
            compact_json(json.text()).find(R"("fallback":true)") != std::string::npos;
      } else {
        json.skip();
      }
    }
    return members;
  }

  [[nodiscard]] std::uint64_t size_of(const std::string& uri, std::size_t buffer) const {
    const std::filesystem::path file = decoded(uri);
    const bool leads_out = file.is_absolute() || std::ranges::find(file, "..") != file.end();
    const auto size = leads_out ? std::nullopt : size_in_folder(folder_ / file, folder_);
    if (!size)
      fail("buffer " + std::to_string(buffer) + ": " + in_quotes(uri) +
           " is no file in its folder; put it there");
    return *size;
  }

  std::string_view text_;
  const std::filesystem::path& folder_;
  std::string_view name_;
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

tinygltf::Model load_gltf(std::string_view content, const std::filesystem::path& folder,
                          std::string_view name) {
  if (content.size() > most_bytes) throw InputError(std::string(name) + ": larger than 4 GiB");
  const bool is_binary = content.starts_with("glTF");
  const std::optional<std::string_view> json = is_binary ? json_chunk(content) : content;
  if (!json) throw InputError(std::string(name) + ": not glTF: cut off");
  std::string text = Filter(without_mark(*json), folder, name).run();
  if (is_binary) text = with_json(content, std::move(text));
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  std::filesystem::path home = folder;
  loader.SetFsCallbacks({exists_in_folder, as_it_is, read_in_folder, write_nothing, &home});
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool is_loaded = false;
  try {
    const auto size = static_cast<unsigned>(text.size());
    is_loaded =
        is_binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                reinterpret_cast<const unsigned char*>(text.data()),
                                                size, home.string())
                  : loader.LoadASCIIFromString(&model, &error, &warning, text.data(), size,
                                               home.string());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& thrown) {  // some of what it does not expect
    error = thrown.what();
  }
  if (!is_loaded)
    throw InputError(std::string(name) +
                     ": not glTF: " + (error.empty() ? "cut off" : first_line(error)));
  unpack_views(model, name);
  return model;
}

}  // namespace loft::io
