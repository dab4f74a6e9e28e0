// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "app/capture/capture.h"
#include "app/capture/feed.h"
#include "app/server/shown.h"

namespace loft::app {

/// Serves a surface over HTTP: what viewers need, surfaces out, and edits in where there is a
/// capture.
///
///     POST /slices            one or many edits, a line each (io/stacks/edit.h): answered once
///     they are in
///                             the surface and, with a session, durable. 200 if all were taken;
///                             each line is by itself: where some are bad the others are taken all
///                             the same, and the answer says of each what became of it. 400 a line
///                             is no edit, 408 too slow, 411 of unknown length, 413 too large, 422
///                             an edit was rejected, 503 too many wait (Retry-After): none from
///                             there on was taken, 507 the session could not be written: none was
///                             kept
///     POST /undo, /redo       takes the last edit back, or does it again (history.h): another
///     edit,
///                             answered as one of /slices; 409 where there is nothing to undo
///     GET /history            the last 1,000 edits, and whether there is something to undo
///     GET /surface.glb        the surface as it is; also .gltf .ply .stl .obj .off; of a file that
///                             is only shown, in its own format
///     GET /slabs/{id}.glb     a slab (io/gltf/slab_glb.h); 404 when it is gone
///     GET /slabs?ids=...      many slabs (slab_ranges.h) as GLBs one behind the other, labels and
///                             ranges of heights together (io::bundle_glb), as many as fit into an
///                             answer; 404 when all are gone
///     GET /slices             all heights; ?z=1.25 the slice at that height, as a line
///     GET /events             server-sent events: `reset` with all that there is, then `change`
///                             for each edit; a reader that comes back with Last-Event-ID, or
///                             ?after= with the last one's id, gets what it has missed
///     GET /labels             of each label: colour, slices, volume, area, whether it is a skin
///                             (shown_label.h)
///     GET /status             counts, latencies, memory
///     GET /                   the viewer
///
/// Nothing that comes over the network names a file. The `Host` of a request must be this machine
/// (or what --host names, or an address) with the port; changes from pages of other sites
/// (`Origin`, `Sec-Fetch-Site`) are refused: 403. Where others than this machine can reach it
/// changes need `Authorization: Bearer TOKEN`: 401. Ranges are not served. What is too large, too
/// slow or not clear about where it ends is refused (400, 408, 413, 414, 431) and its connection
/// closed (gate.h).
class Server {
 public:
  struct Setup {
    std::string host = "127.0.0.1";
    /// Needed for changes where it is not empty; drawn where the host is not this machine alone.
    std::string token = {};
    int port = 0;                                     ///< 0: any that is free
    std::size_t most_bytes = std::size_t{16} << 20U;  ///< of a body
  };

  /// Binds and serves, in threads of its own. Throws Error where the address cannot be bound.
  /// `capture` takes edits; null: there is nothing to edit.
  Server(const Setup& setup, Shown& shown, const Feed& feed, Capture* capture);
  /// Lets requests end that have begun.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// `http://127.0.0.1:8080/`
  [[nodiscard]] const std::string& url() const { return url_; }
  /// What changes need; empty: nothing.
  [[nodiscard]] const std::string& token() const { return token_; }

 private:
  class Routes;

  std::string url_;
  std::string token_;
  std::unique_ptr<Routes> routes_;
};

}  // namespace loft::app
