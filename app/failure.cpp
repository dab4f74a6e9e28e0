// SPDX-License-Identifier: MIT
#include "app/failure.h"

#include <exception>
#include <new>

#include "io/bytes/file.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"

namespace loft::app {

Failure current_failure() {
  try {
    throw;
  } catch (const UsageError& error) {
    return {error.what(), ExitCode::usage};
  } catch (const loft::io::UnknownFormat& error) {
    return {error.what(), ExitCode::usage};
  } catch (const loft::InputError& error) {
    return {error.what(), ExitCode::bad_input};
  } catch (const loft::io::FileError& error) {
    const bool is_reading = error.access() == loft::io::Access::read;
    return {error.what(), is_reading ? ExitCode::bad_input : ExitCode::cannot_write};
  } catch (const loft::Cancelled&) {
    return {"interrupted; nothing was written", ExitCode::interrupted};
  } catch (const Interrupted& error) {
    return {error.what(), ExitCode::interrupted};
  } catch (const loft::Error& error) {
    return {error.what(), ExitCode::cannot_write};
  } catch (const std::bad_alloc&) {
    return {"out of memory", ExitCode::bad_input};
  }
}

}  // namespace loft::app
