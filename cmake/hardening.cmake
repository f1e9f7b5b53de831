# What a distribution wants of its programs: addresses that cannot be changed after the
# start, and, in what reads files of strangers, checked bounds. The library's own loops,
# which read nothing, are spared the latter.

foreach(target pcl_kss_icp pcl_kss_icp_tool pcl_kss_icp_view pcl_kss_icp_batch
    pcl_kss_icp_multiview pcl_kss_icp_multiview_tool)
  foreach(flag -Wl,-z,relro -Wl,-z,now)
    string(MAKE_C_IDENTIFIER "has${flag}" has)
    check_linker_flag(CXX ${flag} ${has})
    if(TARGET ${target} AND ${has})
      target_link_options(${target} PRIVATE ${flag})
    endif()
  endforeach()
endforeach()
foreach(target pcl_kss_icp_tool pcl_kss_icp_view pcl_kss_icp_batch
    pcl_kss_icp_multiview_tool pcl_kss_icp_command_line pcl_kss_icp_files)
  if(TARGET ${target})
    # none of it without optimization, nor beside sanitizers, whose presets are of Debug
    target_compile_options(${target} PRIVATE
      "$<$<AND:$<CXX_COMPILER_ID:GNU,Clang>,$<NOT:$<CONFIG:Debug>>>:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  endif()
endforeach()
