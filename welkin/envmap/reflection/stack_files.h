#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <welkin/image/image.h>

namespace welkin {

/// A cube to be written, by a name that is fit for a file ("lobe0-view07").
struct NamedCube {
  std::string name;
  CubeMips cube;
};

/// What a prepared stack is as files: its cubes, and a JSON object (UTF-8, ends with a newline) that says which cube is
/// what and which numbers a renderer needs beside.
struct StackFiles {
  std::vector<NamedCube> cubes;
  std::string json;
};

/// `text` as a JSON string, with its quotes.
std::string json_string(std::string_view text);

}  // namespace welkin
