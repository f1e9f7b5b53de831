# Writes OUTPUT, a header that holds the kernel files of KERNELS as one string. An #include
# names a file beside the one that it stands in; each file is there once, where it comes
# first.
#   cmake -DOUTPUT=kernels.h "-DKERNELS=a.cl;b.cl" -P EmbedKernels.cmake
cmake_minimum_required(VERSION 3.18)

# The whole begins as an #include of each file, and is complete when none is left.
set(source "\n")
foreach(kernel IN LISTS KERNELS)
  string(APPEND source "#include \"${kernel}\"\n")
endforeach()
set(included "")
while(source MATCHES "\n#include \"([^\"\n]+)\"")
  set(include "${CMAKE_MATCH_0}")
  get_filename_component(file "${CMAKE_MATCH_1}" ABSOLUTE)
  set(text "")
  if(NOT file IN_LIST included)
    list(APPEND included "${file}")
    if(NOT EXISTS "${file}")
      message(FATAL_ERROR "A kernel includes ${file}, which does not exist")
    endif()
    file(READ "${file}" text)
    get_filename_component(folder "${file}" DIRECTORY)
    string(REPLACE "\n#include \"" "\n#include \"${folder}/" text "\n${text}")
  endif()
  string(FIND "${source}" "${include}" begin)
  string(LENGTH "${include}" length)
  math(EXPR end "${begin} + ${length}")
  string(SUBSTRING "${source}" 0 ${begin} before)
  string(SUBSTRING "${source}" ${end} -1 after)
  set(source "${before}${text}${after}")
endwhile()
file(WRITE "${OUTPUT}" "#pragma once

namespace pcl {
namespace kss {

/** \\brief The source of all kernels. */
inline constexpr char kernels[] = R\"kernel(${source})kernel\";

} // namespace kss
} // namespace pcl
")
