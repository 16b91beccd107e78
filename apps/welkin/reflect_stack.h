#pragma once
#include <string>

#include <welkin/envmap/reflection/stack_files.h>

namespace welkin {

/// Writes a prepared stack into a folder: each cube as NAME.ktx2 (half floats, all levels) and stack.json, which has what
/// stack_files says and for each cube its file, size, levels and scale. All or nothing: a folder that had to be made goes
/// again on failure. Throws Error naming the file; `input` may not be one of them.
void write_stack(const std::string& folder, const StackFiles& stack, const std::string& input);

}  // namespace welkin
