// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "app/capture/capture.h"
#include "app/commands/commands.h"
#include "io/session/session.h"

namespace loft::app {

/// The capture that a command asks for.
[[nodiscard]] Capture::Setup setup_of(const StreamCommand& command);

/// What a session has to remember so that resuming it makes the same surface.
[[nodiscard]] std::map<std::string, std::string> settings_of(const StreamCommand& command);

/// Throws InputError where a session has fewer edits than that.
void check_at(std::uint64_t count, const io::Session& session, const std::filesystem::path& file);

/// Takes the settings of a session over. Throws UsageError where the command line names another one
/// (StreamCommand::given), with both.
void take_over(const std::map<std::string, std::string>& settings, StreamCommand& command);

}  // namespace loft::app
