// SPDX-License-Identifier: MIT
#include "app/live/shared_scene.h"

#include <algorithm>
#include <new>

namespace loft::app {

namespace {

std::string text_of_change(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// What a scene threw, for whoever asked.
template <class Do>
auto refuse_what_fails(Do act) {
  try {
    return act();
  } catch (const Refusal&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw Refusal(422, error.what());
  } catch (const std::bad_alloc&) {
    throw Refusal(507, "there is not enough memory for that");
  } catch (const std::length_error&) {
    throw Refusal(507, "that is more than there is room for");
  }
}

}  // namespace

Json SharedScene::apply(std::string_view text) {
  const Edit edit = read_edit(text);
  const std::lock_guard lock(mutex_);
  let_time_pass();
  const Json change = refuse_what_fails([&] { return scene_->apply(edit); });
  return {{"event", publish(change)}, {"microseconds", change["microseconds"]}};
}

Json SharedScene::answer(const Question& question) {
  const std::lock_guard lock(mutex_);
  return refuse_what_fails([&] { return scene_->answer(question); });
}

std::optional<std::string> SharedScene::bytes(const Question& question) {
  const std::lock_guard lock(mutex_);
  return refuse_what_fails([&] { return scene_->bytes(question); });
}

void SharedScene::advance() {
  const std::lock_guard lock(mutex_);
  let_time_pass();
}

std::pair<std::string, std::uint64_t> SharedScene::state() {
  const std::lock_guard lock(mutex_);
  return {text_of_change(scene_->state()), feed_.last() + 1};
}

void SharedScene::let_time_pass() {
  const auto now = Clock::now();
  const std::chrono::duration<double> passed = now - std::exchange(now_, now);
  const Json change = scene_->advance(std::min(passed.count(), 1.0));
  if (!change.is_null()) publish(change);
}

std::uint64_t SharedScene::publish(const Json& change) {
  std::string text = text_of_change(change);
  if (text.size() > most_bytes) text.clear();
  return feed_.publish(std::move(text));
}

}  // namespace loft::app
