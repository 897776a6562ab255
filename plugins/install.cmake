# cmake --install: programs, plugins, resources, and what an author of plugins needs. Everything finds the rest relative
# to itself, so the installed folder may be moved.
include(CMakePackageConfigHelpers)
set(UCHILSIM_INSTALL_LIBRARY lib/uchilsim)
set(UCHILSIM_INSTALL_PLUGINS ${UCHILSIM_INSTALL_LIBRARY}/plugins)
set(UCHILSIM_INSTALL_CORE ${UCHILSIM_INSTALL_LIBRARY}/libbtr_core.so)
set(UCHILSIM_INSTALL_HEADERS include/uchilsim)
set(UCHILSIM_INSTALL_RESOURCES share/uchilsim)
set(UCHILSIM_INSTALL_BTR bin/btr)
file(STRINGS ${CMAKE_SOURCE_DIR}/core/plugin/plugin.h UCHILSIM_PLUGIN_API REGEX "int pluginApiVersion = ")
string(REGEX MATCH "[0-9]+" UCHILSIM_PLUGIN_API "${UCHILSIM_PLUGIN_API}")

# Component "window" is the workbench; everything else is "headless".
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME headless)
set_target_properties(btr btr-serve PROPERTIES INSTALL_RPATH "$ORIGIN/../${UCHILSIM_INSTALL_LIBRARY}")
install(TARGETS btr btr-serve RUNTIME DESTINATION bin)
# For PYTHONPATH, or a line in a .pth file of a venv; its examples lie beside it.
install(DIRECTORY ${PYTHON_PACKAGE} DESTINATION ${UCHILSIM_INSTALL_RESOURCES}/python PATTERN __pycache__ EXCLUDE)
install(FILES core/remote/uchilsim.proto DESTINATION ${UCHILSIM_INSTALL_RESOURCES})
if(UCHILSIM_UI)
  set_target_properties(uchilsim btr-camera PROPERTIES INSTALL_RPATH "$ORIGIN/../${UCHILSIM_INSTALL_LIBRARY}")
  install(TARGETS uchilsim btr-camera RUNTIME DESTINATION bin COMPONENT window)
endif()
install(TARGETS btr_core btr_openr_runtime LIBRARY DESTINATION ${UCHILSIM_INSTALL_LIBRARY})
set_target_properties(openr_robot openr_tool PROPERTIES INSTALL_RPATH "$ORIGIN/../${UCHILSIM_INSTALL_LIBRARY}")
install(TARGETS openr_robot openr_tool RUNTIME DESTINATION bin)
install(DIRECTORY core/openr/sdk/ DESTINATION ${UCHILSIM_INSTALL_RESOURCES}/openr-sdk USE_SOURCE_PERMISSIONS)
foreach(plugin ${PLUGIN_TARGETS})
  get_target_property(folder ${plugin} LIBRARY_OUTPUT_DIRECTORY)
  get_filename_component(kind ${folder} NAME)
  set_target_properties(${plugin} PROPERTIES INSTALL_RPATH "$ORIGIN/../..")
  install(TARGETS ${plugin} LIBRARY DESTINATION ${UCHILSIM_INSTALL_PLUGINS}/${kind})
endforeach()
install(DIRECTORY resources/ DESTINATION ${UCHILSIM_INSTALL_RESOURCES} PATTERN manual EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION share/doc/uchilsim)

# The public headers are those that plugin.h includes, followed from file to file.
set(public core/plugin/plugin.h)
set(next ${public})
while(next)
  list(POP_FRONT next header)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  file(STRINGS ${CMAKE_SOURCE_DIR}/${header} lines REGEX "^#include \"core/")
  foreach(line ${lines})
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" found "${line}")
    if(NOT found IN_LIST public)
      list(APPEND public ${found})
      list(APPEND next ${found})
    endif()
  endforeach()
endwhile()
foreach(header ${public})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${UCHILSIM_INSTALL_HEADERS}/${folder})
endforeach()

set(package lib/cmake/UCHILSIM)
configure_package_config_file(plugins/UCHILSIMConfig.cmake.in ${CMAKE_BINARY_DIR}/UCHILSIMConfig.cmake
  INSTALL_DESTINATION ${package}
  PATH_VARS UCHILSIM_INSTALL_PLUGINS UCHILSIM_INSTALL_CORE UCHILSIM_INSTALL_HEADERS UCHILSIM_INSTALL_RESOURCES
            UCHILSIM_INSTALL_BTR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/UCHILSIMConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/UCHILSIMConfig.cmake ${CMAKE_BINARY_DIR}/UCHILSIMConfigVersion.cmake
  plugins/UCHILSIMPlugin.cmake DESTINATION ${package})
