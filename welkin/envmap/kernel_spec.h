#pragma once
#include <string>
#include <string_view>

#include <welkin/envmap/zonal_kernel.h>

// Kernels as text, for command lines.

namespace welkin {

/// Reads one of
///   ggx:ALPHA  phong:N  blinn-phong:N  gaussian:SIGMA  vmf:KAPPA  lambert  table:FILE
/// SIGMA is in radians, or in degrees with "deg" after it (gaussian:5deg); FILE is read by load_kernel_table. Throws
/// Error that names the choices, or what is wrong with the number or the file.
ZonalKernel parse_kernel(std::string_view spec);

/// The forms above as one text for --help.
std::string kernel_spec_help();

/// The families that kernel_for_alpha knows: "ggx", "phong", "blinn-phong", "gaussian", "vmf". Throws Error naming them.
KernelKind parse_kernel_family(std::string_view name);

}  // namespace welkin
