# The manual page of the command line tool, made of its --help by help2man. Without
# help2man, or where the tool cannot run here, there is none.

find_program(PCL_KSS_ICP_HELP2MAN help2man DOC "help2man, for the manual page")
if(NOT PCL_KSS_ICP_HELP2MAN OR CMAKE_CROSSCOMPILING)
  return()
endif()
set(man_page ${PROJECT_BINARY_DIR}/pcl_kss_icp.1)
add_custom_command(
  OUTPUT ${man_page}
  COMMAND ${PCL_KSS_ICP_HELP2MAN} --no-info --section 1 --output ${man_page}
    --name "register two point clouds without an initial guess"
    --include ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m
    $<TARGET_FILE:pcl_kss_icp_tool>
  DEPENDS pcl_kss_icp_tool ${PROJECT_SOURCE_DIR}/cmake/man_page.h2m
  VERBATIM)
add_custom_target(man_page ALL DEPENDS ${man_page})
install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
