#pragma once
#include <optional>

#include <CLI/CLI.hpp>

#include <welkin/envmap/methods/filter_method.h>

namespace welkin {

/// Declares the options of every method on a command; they are written to `options`.
void add_method_options(CLI::App& sub, FilterMethodOptions& options);

/// Throws CLI::ValidationError where an option was given that belongs to another method; no method: all of them, where every
/// option belongs.
void check_method_options(const CLI::App& sub, std::optional<FilterMethod> method);

}  // namespace welkin
