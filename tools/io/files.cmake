# Files: what they hold, and how they are read and written; a library for the command
# line tool, for the tests, and for the evaluation.
if(TARGET pcl_kss_icp_files)
  return()
endif()
find_package(PCL 1.12 REQUIRED COMPONENTS common)

set(files_dir ${CMAKE_CURRENT_LIST_DIR})
add_library(pcl_kss_icp_files STATIC
  ${files_dir}/numbers.cpp
  ${files_dir}/fields.cpp
  ${files_dir}/vector_field.cpp
  ${files_dir}/geometry.cpp
  ${files_dir}/file_format.cpp
  ${files_dir}/text_encoding.cpp
  ${files_dir}/text_lines.cpp
  ${files_dir}/read_geometry.cpp
  ${files_dir}/pcd_header.cpp
  ${files_dir}/lzf.cpp
  ${files_dir}/read_pcd.cpp
  ${files_dir}/ply_header.cpp
  ${files_dir}/ply_values.cpp
  ${files_dir}/read_ply.cpp
  ${files_dir}/read_off.cpp
  ${files_dir}/read_obj.cpp
  ${files_dir}/read_stl.cpp
  ${files_dir}/column_names.cpp
  ${files_dir}/text_rows.cpp
  ${files_dir}/text_header.cpp
  ${files_dir}/text_table.cpp
  ${files_dir}/read_text.cpp
  ${files_dir}/read_ptx.cpp
  ${files_dir}/mesh_orientation.cpp
  ${files_dir}/mesh_sampling.cpp
  ${files_dir}/losses.cpp
  ${files_dir}/write_geometry.cpp
  ${files_dir}/write_pcd.cpp
  ${files_dir}/write_ply.cpp
  ${files_dir}/write_obj.cpp
  ${files_dir}/write_off.cpp
  ${files_dir}/write_text.cpp
  ${files_dir}/write_ptx.cpp
  ${files_dir}/write_stl.cpp)
target_compile_features(pcl_kss_icp_files PUBLIC cxx_std_17)
target_compile_options(pcl_kss_icp_files PRIVATE -Wall -Wextra)
target_include_directories(pcl_kss_icp_files PUBLIC ${files_dir}/..)
target_link_libraries(pcl_kss_icp_files
  PUBLIC pcl_common Eigen3::Eigen)
