# cmake -DOUTPUT=FILE.cpp -DNAMESPACE=a::b -DFILES="kName=path|kName=path" -P embed_text.cmake
# Writes a source file with each text as `extern const char* const kName`.
set(source "// Made by embed_text.cmake.\nnamespace ${NAMESPACE} {\n")
string(REPLACE "|" ";" entries "${FILES}")
foreach(entry ${entries})
    string(REGEX MATCH "^([^=]+)=(.+)$" matched "${entry}")
    set(name ${CMAKE_MATCH_1})
    file(READ ${CMAKE_MATCH_2} hex HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
    string(APPEND source "static const char ${name}Text[] = {${bytes}'\\0'};\n"
                         "extern const char* const ${name};\n"
                         "const char* const ${name} = ${name}Text;\n")
endforeach()
file(WRITE ${OUTPUT} "${source}}  // namespace ${NAMESPACE}\n")
