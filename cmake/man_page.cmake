# The manual pages of the programs, made of their --help by help2man. Without help2man, or
# where the programs cannot run here, there are none.

find_program(PCL_KSS_ICP_HELP2MAN help2man DOC "help2man, for the manual pages")
if(NOT PCL_KSS_ICP_HELP2MAN OR CMAKE_CROSSCOMPILING)
  return()
endif()
add_custom_target(man_page ALL)

# kss_icp_man_page(<target> <name> <component> <what it does> <option of help2man>...)
function(kss_icp_man_page target name component summary)
  if(NOT TARGET ${target})
    return()
  endif()
  set(page ${PROJECT_BINARY_DIR}/${name}.1)
  add_custom_command(
    OUTPUT ${page}
    COMMAND ${PCL_KSS_ICP_HELP2MAN} --no-info --section 1 --output ${page}
      --name ${summary} ${ARGN} $<TARGET_FILE:${target}>
    DEPENDS ${target} ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m
    VERBATIM)
  add_custom_target(man_page_${name} DEPENDS ${page})
  add_dependencies(man_page man_page_${name})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()

kss_icp_man_page(pcl_kss_icp_tool pcl_kss_icp tool
  "register two point clouds without an initial guess"
  --include ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m)
kss_icp_man_page(pcl_kss_icp_batch pcl_kss_icp_batch batch
  "register many pairs of point clouds"
  --include ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m)
kss_icp_man_page(pcl_kss_icp_multiview_tool pcl_kss_icp_multiview batch
  "find the poses of many scans"
  --include ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m)
kss_icp_man_page(pcl_kss_icp_view pcl_kss_icp_view view
  "show what pcl_kss_icp has registered" --version-string ${PROJECT_VERSION})
