# Builds the page with npm and writes the source that puts its files into the program.
# cmake -DNPM=npm -DFROM=studio/page -DPAGE=build/studio/page -DOUTPUT=page_files.cpp -P build_page.cmake
# NPM empty, or an npm that cannot reach its registry: the source holds no file.

# Sets `list` to the entries of page_files(), and `bytes` to the assembler that brings the files in.
function(entries_of folder)
  file(GLOB_RECURSE files RELATIVE ${folder} ${folder}/*)
  set(count 0)
  foreach(file ${files})
    get_filename_component(ending ${file} LAST_EXT)
    set(type "application/octet-stream")
    if(ending STREQUAL ".html")
      set(type "text/html; charset=utf-8")
    elseif(ending STREQUAL ".js")
      set(type "text/javascript; charset=utf-8")
    elseif(ending STREQUAL ".css")
      set(type "text/css; charset=utf-8")
    elseif(ending STREQUAL ".svg")
      set(type "image/svg+xml")
    endif()
    string(APPEND bytes "asm(\".section .rodata\\nhysteron_page_${count}:\\n.incbin \\\"${folder}/${file}\\\"\\n\"
    \"hysteron_page_${count}_end:\\n.byte 0\\n.previous\\n\");
extern \"C\" const char hysteron_page_${count}[], hysteron_page_${count}_end[];\n")
    string(APPEND list "      {\"/${file}\", \"${type}\", {hysteron_page_${count}, static_cast<std::size_t>(hysteron_page_${count}_end - hysteron_page_${count})}},\n")
    math(EXPR count "${count} + 1")
  endforeach()
  set(bytes "${bytes}" PARENT_SCOPE)
  set(list "${list}" PARENT_SCOPE)
endfunction()

set(bytes "")
set(list "")
if(NPM)
  file(REMOVE_RECURSE ${PAGE}/src ${PAGE}/dist)
  file(COPY ${FROM}/ DESTINATION ${PAGE} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)
  file(SHA256 ${PAGE}/package-lock.json lock)
  set(installed "")
  if(EXISTS ${PAGE}/installed.txt)
    file(READ ${PAGE}/installed.txt installed)
  endif()
  set(failed 0)
  if(NOT installed STREQUAL lock)
    execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
                    WORKING_DIRECTORY ${PAGE} RESULT_VARIABLE failed)
    if(NOT failed)
      file(WRITE ${PAGE}/installed.txt ${lock})
    endif()
  endif()
  if(failed)
    message(WARNING "npm could not install what the page of hysteron studio needs; it is left out of the program. "
                    "Build again where the registry of npm can be reached.")
  else()
    execute_process(COMMAND ${NPM} run --silent build WORKING_DIRECTORY ${PAGE} RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "the page of hysteron studio does not build (its reason stands above)")
    endif()
    entries_of(${PAGE}/dist)
  endif()
endif()

file(WRITE ${OUTPUT} "// Made by studio/build_page.cmake from studio/page; do not edit.
#include \"studio/page_files.h\"

${bytes}
namespace hysteron::studio {

const std::vector<PageFile>& page_files() {
  static const std::vector<PageFile> files{
${list}  };
  return files;
}

}  // namespace hysteron::studio
")
