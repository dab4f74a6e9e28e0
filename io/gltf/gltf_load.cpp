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
#include "io/bytes/little_endian.h"
#include "io/bytes/text.h"
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
    constexpr std::array<std::string_view, 8> kept{"asset",  "scene",     "scenes",      "nodes",
                                                   "meshes", "accessors", "bufferViews", "buffers"};
    JsonReader json(text_, "text");
    if (json.peek() != JsonKind::object) fail("not glTF: " + reject(json, "an object"));
    std::string result = "{";
    json.begin_object();
    while (const auto key = json.next_key()) {
      const bool is_kept = std::ranges::find(kept, *key) != kept.end();
      if (*key == "buffers") look_at_buffers(json);
      const std::size_t begin = json.place();
      json.skip();
      if (!is_kept) continue;
      if (result.size() > 1) result += ',';
      append_json_string(result, *key);
      result += ':';
      result += text_.substr(begin, json.place() - begin);
    }
    json.end();
    return result + '}';
  }

  /// From a copy of the reader, which stays where it is.
  void look_at_buffers(JsonReader json) {
    if (json.peek() != JsonKind::list) fail("not glTF: \"buffers\": " + reject(json, "a list"));
    json.begin_list();
    std::uint64_t total = 0;
    std::size_t inside = 0;
    for (std::size_t i = 0; json.next_item(); ++i) {
      if (json.peek() != JsonKind::object) fail("not glTF: " + reject(json, "a buffer"));
      const std::optional<std::string> uri = uri_of(json);
      if (!uri && ++inside > 1) fail("more than one buffer without \"uri\"");
      if (uri && !uri->starts_with("data:")) total += size_of(*uri, i);
      if (total > most_bytes) fail("its buffers are larger than 4 GiB");
    }
  }

  static std::optional<std::string> uri_of(JsonReader& json) {
    std::optional<std::string> uri;
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == "uri" && json.peek() == JsonKind::string) {
        uri = json.string();
      } else {
        json.skip();
      }
    }
    return uri;
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

// --- GLB: a header of three numbers, then chunks with their sizes ---

constexpr std::size_t glb_header = 12;
constexpr std::size_t chunk_header = 8;

std::string_view json_chunk(std::string_view glb, std::string_view name) {
  constexpr std::uint32_t json_type = 0x4e4f534a;
  if (glb.size() >= glb_header + chunk_header) {
    const std::size_t size = get<std::uint32_t>(glb.data() + glb_header);
    const bool is_json = get<std::uint32_t>(glb.data() + glb_header + 4) == json_type;
    if (is_json && size <= glb.size() - glb_header - chunk_header)
      return glb.substr(glb_header + chunk_header, size);
  }
  throw InputError(std::string(name) + ": not glTF: cut off");
}

/// The same file with other JSON.
std::string with_json(std::string_view glb, std::size_t old_size, std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string result(glb.substr(0, glb_header + chunk_header));
  result += json;
  result += glb.substr(glb_header + chunk_header + old_size);
  put(result.data() + 8, static_cast<std::uint32_t>(result.size()));
  put(result.data() + glb_header, static_cast<std::uint32_t>(json.size()));
  return result;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

tinygltf::Model load_gltf(std::string_view content, const std::filesystem::path& folder,
                          std::string_view name) {
  if (content.size() > most_bytes) throw InputError(std::string(name) + ": larger than 4 GiB");
  const bool is_binary = content.starts_with("glTF");
  const std::string_view json = is_binary ? json_chunk(content, name) : content;
  std::string text = Filter(without_mark(json), folder, name).run();
  if (is_binary) text = with_json(content, json.size(), std::move(text));
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
  return model;
}

}  // namespace loft::io
