#include <cstddef>
#include <cstdint>

#include <welkin/brdf/merl.h>
#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/load.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/forms/document.h>

// A reader may return or throw welkin::Error, whatever the bytes; anything else is a finding. WELKIN_READER is the
// function under test, e.g. decode_hdr.

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  welkin::set_thread_count(1);  // threads would only blur the coverage
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    welkin::WELKIN_READER({data, size}, "fuzz");
  } catch (const welkin::Error&) {
  }
  return 0;
}
