# `cpack -G DEB` (./dev package): one Debian package for each component.
set(CPACK_PACKAGE_NAME samara)
set(CPACK_PACKAGE_CONTACT "the samara project")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL core runtime)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_CORE_PACKAGE_NAME samara-core)
set(CPACK_COMPONENT_CORE_DESCRIPTION
  "The core: what a game engine or a simulator embeds. Reads body files and flies bodies:
the C interface (libsamara-core.so, samara.h) and the C++ library.")
set(CPACK_DEBIAN_CORE_PACKAGE_SUGGESTS "samara-runtime, libeigen3-dev, libhdf5-dev, libfmt-dev, libhwy-dev")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME samara-runtime)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "samara-core (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
  "The runtime: simulates bodies with precomputed added mass, load and turbulence tables,
exports their motion to animation tools and plots it. With ready-baked
bodies, the C interface (libsamara.so, samara.h) and the C++ library.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "python3-matplotlib, python3-jinja2")
# For programs in C++ that find_package(samara).
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS
  "samara-baking, samara-mujoco, libeigen3-dev, libhdf5-dev, libfmt-dev, libhwy-dev, libtinygltf-dev, libtomlplusplus-dev, nlohmann-json3-dev")

if(TARGET samara_mujoco)
  list(APPEND CPACK_COMPONENTS_ALL mujoco)
  set(CPACK_DEBIAN_MUJOCO_PACKAGE_NAME samara-mujoco)
  set(CPACK_COMPONENT_MUJOCO_DESCRIPTION "The fluid for bodies of MuJoCo, by the model's XML: libsamara-mujoco.so.")
  set(CPACK_DEBIAN_MUJOCO_PACKAGE_DEPENDS "samara-runtime (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/runtime)  # of libsamara.so, which another package holds
endif()

if(TARGET samara_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-samara)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The Python module: scenes to motions as numpy arrays, figures and comparisons, live
flights.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-jinja2")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "samara-runtime (= ${PROJECT_VERSION}), ${SAMARA_PYTHON_DEPENDS}")
endif()

if(SAMARA_BAKING)
  list(APPEND CPACK_COMPONENTS_ALL baking)
  set(CPACK_DEBIAN_BAKING_PACKAGE_NAME samara-baking)
  set(CPACK_COMPONENT_BAKING_DESCRIPTION
    "The baking tools: mesh shapes with gmsh, solve the flow around them with OpenFOAM and
make the body files that samara-runtime flies; falls by full CFD to validate
them.")
  set(CPACK_DEBIAN_BAKING_PACKAGE_DEPENDS
    "samara-runtime (= ${PROJECT_VERSION}), openfoam, snakemake, python3")
endif()
include(CPack)
