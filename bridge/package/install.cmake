# What `cmake --install` lays down: headers as include/pantin/MODULE/name.hpp, one library and one exported target a
# component, the package for find_package(pantin COMPONENTS ...), a pkg-config file a component, program, licence.
#
# What a component needs is read off its target, so nothing is told twice: pantin::OTHER are components, the rest is
# looked up here: name of the package for find_package, name for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_of_fcl fcl)
set(package_of_urdfdom::urdfdom_model urdfdom)
set(package_of_tinyxml2::tinyxml2 tinyxml2)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pantin)
file(RELATIVE_PATH up_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" up_from_pkgconfig "${up_from_pkgconfig}")
get_property(components GLOBAL PROPERTY PANTIN_COMPONENTS)
set(needs_of_components "")
foreach(component ${components})
  set(target pantin_${component})
  get_target_property(links ${target} LINK_LIBRARIES)
  set(needs "")
  set(packages "")
  set(pc_requires eigen3)
  set(pc_libs "")
  foreach(link ${links})
    if(link MATCHES "^pantin::(.*)$")
      list(APPEND needs ${CMAKE_MATCH_1})
      list(APPEND pc_requires pantin-${CMAKE_MATCH_1})
    elseif(DEFINED package_of_${link})
      list(APPEND packages ${package_of_${link}})
      list(APPEND pc_requires ${package_of_${link}})
    elseif(link STREQUAL "${CMAKE_DL_LIBS}")
      string(APPEND pc_libs " -l${link}")
    elseif(NOT link STREQUAL "Eigen3::Eigen" AND NOT link MATCHES "^\\$<BUILD_INTERFACE")
      message(FATAL_ERROR "component ${component} links ${link}, of which bridge/package/install.cmake knows no package")
    endif()
  endforeach()
  string(APPEND needs_of_components "set(pantin_needs_${component} \"${needs}\")\n"
                                    "set(pantin_packages_${component} \"${packages}\")\n")

  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT pantin-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT pantin-${component} NAMESPACE pantin:: DESTINATION ${package_folder}
          FILE pantin-${component}-targets.cmake)

  list(JOIN pc_requires ", " pc_requires)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/component.pc.in ${PROJECT_BINARY_DIR}/package/pantin-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/pantin-${component}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pantinConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/pantinConfig.cmake INSTALL_DESTINATION ${package_folder}
  PATH_VARS CMAKE_INSTALL_LIBEXECDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/pantinConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/pantinConfig.cmake
  ${PROJECT_BINARY_DIR}/package/pantinConfigVersion.cmake DESTINATION ${package_folder})

foreach(module scenegraph physics bridge)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pantin
          FILES_MATCHING PATTERN "*.hpp" PATTERN cli EXCLUDE PATTERN package EXCLUDE)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/bridge/pantin.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pantin)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/pantin)
if(TARGET pantin)
  install(TARGETS pantin RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# `cmake --build --preset minimal --target pantin_sizes` prints what each library weighs.
find_program(PANTIN_SIZE size)
if(PANTIN_SIZE)
  list(TRANSFORM components REPLACE "(.+)" "$<TARGET_FILE:pantin_\\1>" OUTPUT_VARIABLE files)
  add_custom_target(pantin_sizes
    COMMAND ${CMAKE_COMMAND} -D SIZE=${PANTIN_SIZE} -D "FILES=${files}"
            -P ${CMAKE_CURRENT_LIST_DIR}/print_sizes.cmake VERBATIM)
  list(TRANSFORM components PREPEND pantin_ OUTPUT_VARIABLE targets)
  add_dependencies(pantin_sizes ${targets})
endif()
