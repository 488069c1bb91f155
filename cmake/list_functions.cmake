# Blocks, effects and verbs are found by the build: each is a function without arguments that stands in a file of its own,
# and what follows writes the source that lists these functions.

# Finds functions in FILES (relative to the folder that calls) by lines of the form
#   TYPE name()     or, with SUFFIX _block,     TYPE name_block()
# with which ENDING goes on (";" of a declaration, " {" of a definition), and writes a source with the function
#   std::vector<TYPE (*)()> NAMESPACE::LIST()
# that includes HEADER, the file that declares it. Sets LIST in the caller to the path of that source.
# ORDER, if it is given, is a file with one name a line: these come first, in this order; the others follow by path. Since it is there for the eye
# alone (the order in which lists are printed), nothing new has to be written into it.
# A file without such a function, a name that two files have and a name in ORDER that no file has stop the build with what
# to do; CURE says it for the first case.
function(hysteron_list_functions LIST)
  cmake_parse_arguments(PARSE_ARGV 1 L "" "TYPE;SUFFIX;ENDING;NAMESPACE;HEADER;ORDER;CURE" "FILES")
  string(REGEX REPLACE "([{}])" "[\\1]" ending "${L_ENDING}")
  set(found)
  foreach(file ${L_FILES})
    # A changed file may have another function: the build looks again.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(STRINGS ${file} lines REGEX "^${L_TYPE} [a-z0-9_]+${L_SUFFIX}\\(\\)${ending}")
    if(NOT lines)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${file}: no line \"${L_TYPE} name${L_SUFFIX}()${L_ENDING}\". ${L_CURE}")
    endif()
    foreach(line ${lines})
      string(REGEX REPLACE "^${L_TYPE} ([a-z0-9_]+)${L_SUFFIX}\\(\\).*" "\\1" name "${line}")
      if(DEFINED file_of_${name})
        message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${file}: \"${name}\" is there already, in ${file_of_${name}}; "
                            "choose another name.")
      endif()
      set(file_of_${name} ${file})
      list(APPEND found ${name})
    endforeach()
  endforeach()

  set(names)
  set(sorted "")
  if(L_ORDER)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${L_ORDER})
    file(STRINGS ${L_ORDER} names REGEX "^[a-z0-9_]+$")
    set(sorted " and ${L_ORDER}")
  endif()
  foreach(name ${names})
    if(NOT name IN_LIST found)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${L_ORDER}: there is no \"${L_TYPE} ${name}${L_SUFFIX}()\"; "
                          "remove the name \"${name}\" or write it as the function is called.")
    endif()
  endforeach()
  list(APPEND names ${found})
  list(REMOVE_DUPLICATES names)

  set(declarations)
  set(entries)
  foreach(name ${names})
    string(APPEND declarations "${L_TYPE} ${name}${L_SUFFIX}();\n")
    string(APPEND entries "    ${name}${L_SUFFIX},\n")
  endforeach()
  set(path ${CMAKE_CURRENT_BINARY_DIR}/${LIST}.cpp)
  file(CONFIGURE OUTPUT ${path} @ONLY CONTENT [[
// Made by the build (cmake/list_functions.cmake) from the sources@sorted@.
#include "@L_HEADER@"

namespace @L_NAMESPACE@ {

@declarations@
std::vector<@L_TYPE@ (*)()> @LIST@() {
  return {
@entries@  };
}

}  // namespace @L_NAMESPACE@
]])
  set(${LIST} ${path} PARENT_SCOPE)
endfunction()

# Sets `list` to the sources of `folder` that have no header of their name: those of which each is one effect, one verb.
# The others serve them.
function(hysteron_sources_without_header list folder)
  file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/*.cpp)
  file(GLOB headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${folder}/*.h)
  list(TRANSFORM headers REPLACE "[.]h$" ".cpp")
  list(REMOVE_ITEM sources ${headers})
  set(${list} ${sources} PARENT_SCOPE)
endfunction()
