# Writes OUTPUT, a header that holds each kernel file of KERNELS as a string named after it.
#   cmake -DOUTPUT=kernels.h -DKERNELS="a.cl;b.cl" -P EmbedKernels.cmake
set(text "#pragma once\n\nnamespace pcl {\nnamespace kss {\nnamespace kernels {\n\n")
foreach(kernel IN LISTS KERNELS)
  get_filename_component(name "${kernel}" NAME_WE)
  file(READ "${kernel}" source)
  string(APPEND text "inline constexpr char ${name}[] = R\"kernel(${source})kernel\";\n\n")
endforeach()
string(APPEND text "} // namespace kernels\n} // namespace kss\n} // namespace pcl\n")
file(WRITE "${OUTPUT}" "${text}")
