# Sources that the page does not need, by module: leaving them out halves the time of the web build. Where a link of that
# build ends with "undefined symbol", take the source that defines it out of this list.
set(WELKIN_NOT_IN_image codecs/ktx2_write.cpp compare.cpp perceptual_difference.cpp z_test.cpp)
set(WELKIN_NOT_IN_sh
  basis_listing.cpp folded_kernels.cpp folded_lookup.cpp hemispherical.cpp minimum.cpp minimum_search.cpp monte_carlo.cpp
  nonnegative.cpp nonnegative_projection.cpp nonnegative_zonal.cpp product.cpp quantity.cpp spin_synthesis.cpp window.cpp
  zh3.cpp forms/code_form.cpp forms/form.cpp forms/json_form.cpp forms/light_lines.cpp forms/read_form.cpp
  forms/write_form.cpp)
set(WELKIN_NOT_IN_brdf merl.cpp scatter/sampling_check.cpp scatter/scatter_spec.cpp)
set(WELKIN_NOT_IN_envmap
  inpaint.cpp laplace_solver.cpp light_fit.cpp light_regions.cpp lights.cpp lights_check.cpp stored_errors.cpp verify.cpp
  reflection/brdf_spectrum.cpp reflection/lafortune_truth.cpp reflection/low_frequency.cpp reflection/shrm.cpp
  reflection/shrm_orders.cpp reflection/stack_files.cpp reflection/truth.cpp methods/angular.cpp methods/bordered.cpp
  methods/box.cpp methods/brute.cpp methods/filter_method.cpp methods/filter_truth.cpp
  methods/frequency.cpp methods/hierarchical.cpp methods/importance.cpp
  methods/paraboloid.cpp methods/planar_filter.cpp methods/quick.cpp)
set(WELKIN_NOT_IN_scene
  gltf_write.cpp mtl.cpp obj.cpp obj_parse.cpp ply.cpp ply_header.cpp polygon.cpp read_scene.cpp file_resolver.cpp)
# The browser brings the context.
set(WELKIN_NOT_IN_realtime gl/headless_context.cpp)
