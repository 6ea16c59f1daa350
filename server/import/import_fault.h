#pragma once

#include "renderer/worker/fault_names.h"

namespace volcast::import {

/// Fails as asked for, inside the sandbox and with the file about to be read; does not return.
[[noreturn]] void strike(worker::Fault fault);

}  // namespace volcast::import
