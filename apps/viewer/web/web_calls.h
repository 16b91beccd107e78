#pragma once
#include <emscripten.h>

#include <exception>
#include <string>

// What is common to the functions that the page's JavaScript calls. All have C names; texts are UTF-8 with a zero at the
// end; a text that is returned stays valid until the next call that returns one.

namespace welkin {

/// Keeps a text for JavaScript.
const char* give_text(std::string text);

void set_last_error(const std::string& message);

/// Calls and returns 1, or 0 where it throws; then welkin_error() tells why.
template <class Call>
int succeeds(const Call& call) {
  try {
    call();
    return 1;
  } catch (const std::exception& error) {
    set_last_error(error.what());
    return 0;
  }
}

}  // namespace welkin
