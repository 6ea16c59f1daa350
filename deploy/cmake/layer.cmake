# volcast_layer(NAME FOLDER [LINK targets...] [ONLY regex] [EXCEPT regex]): a static library of the
# sources directly in FOLDER. Every layer is one target, linked to what its row of the include
# table allows. main.cpp is never part of a layer.
function(volcast_layer name folder)
    cmake_parse_arguments(LAYER "" "ONLY;EXCEPT" "LINK" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
    if(LAYER_ONLY)
        list(FILTER sources INCLUDE REGEX "${LAYER_ONLY}")
    endif()
    if(LAYER_EXCEPT)
        list(FILTER sources EXCLUDE REGEX "${LAYER_EXCEPT}")
    endif()
    if(sources)
        add_library(${name} STATIC ${sources})
        target_link_libraries(${name} PUBLIC ${LAYER_LINK})
    else()
        add_library(${name} INTERFACE)
        target_link_libraries(${name} INTERFACE ${LAYER_LINK})
    endif()
endfunction()

# volcast_test(NAME FOLDER LABEL label [LINK targets...]): one GoogleTest program of FOLDER's
# *_test.cpp. `cpu` tests need no GPU, `gl` tests a context, `e2e` tests start real processes.
# What a sanitizer finds ends the process that it was found in, the children included.
function(volcast_test name folder)
    cmake_parse_arguments(TEST "" "LABEL" "LINK" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    if(NOT sources)
        return()
    endif()
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE ${TEST_LINK} GTest::gmock GTest::gtest_main)
    set(sanitizers "")
    set(seconds 300)
    if(VOLCAST_SANITIZE)
        set(seconds 1200)
        set(tsan "halt_on_error=1:atexit_sleep_ms=0")
        string(APPEND tsan ":suppressions=${CMAKE_SOURCE_DIR}/deploy/dev/tsan.supp")
        # LLVM holds more locks while it compiles for Mesa than the search for deadlocks has room
        # for: it would stop the process.
        if(NOT TEST_LABEL STREQUAL cpu)
            string(APPEND tsan ":detect_deadlocks=0")
        endif()
        # Two properties: a list in one of them does not outlive the discovery of tests.
        set(sanitizers
            ENVIRONMENT "UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1"
            ENVIRONMENT_MODIFICATION
            "TSAN_OPTIONS=set:${tsan}")
    endif()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
                         PROPERTIES LABELS ${TEST_LABEL} TIMEOUT ${seconds} ${sanitizers})
endfunction()
