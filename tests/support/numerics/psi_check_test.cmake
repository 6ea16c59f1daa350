# Runs psi_check on the public file, on a copy with one wrong weight, and on what is no such file.
# Needs PROGRAM, FILE (the public one) and FOLDER (to write into).
function(expect code text file)
    execute_process(COMMAND ${PROGRAM} ${file} ${ARGN} RESULT_VARIABLE result
                    OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT result EQUAL ${code} OR NOT "${output}${errors}" MATCHES "${text}")
        message(FATAL_ERROR "psi_check ${file} ${ARGN}: exit ${result}, expected ${code} and "
                            "\"${text}\":\n${output}${errors}")
    endif()
endfunction()

file(MAKE_DIRECTORY ${FOLDER})
expect(0 "319 rows.*\n0 of 319 rows past" ${FILE})
expect(1 "319 rows" ${FILE} --method average)
expect(0 "" --help)
expect(1 "4000 rows" --random 1000 --method average)
expect(2 "FILE.csv or --random" ${FILE} --random 1000)
expect(2 "from 1 to" --random none)

# One row that is right, one whose back weight is 5e-6 too large.
file(READ ${FILE} text)
string(REGEX MATCH "^[^\n]*\n" header "${text}")

# More rows than one batch of the program holds (262,144): none may be mixed up.
string(REPLACE "${header}" "" rows "${text}")
string(REPEAT "${rows}" 900 many)
file(WRITE ${FOLDER}/many.csv "${header}${many}")
expect(0 "287100 rows.*\n0 of 287100 rows past" ${FOLDER}/many.csv)
file(REMOVE ${FOLDER}/many.csv)

file(WRITE ${FOLDER}/broken.csv "${header}1,1,0.36787944117144232,0.36787944117144232,"
     "0.26424111765711536\n1,1,0.36787944117144232,0.36787944117144232,0.26424243886270394\n")
expect(1 "line 3.*1 of 2 rows past" ${FOLDER}/broken.csv)

file(WRITE ${FOLDER}/garbage.csv "${header}1,1,0.3,0.3,0.3\n1,nan,0.3,0.3,0.3\n")
expect(2 "garbage.csv:3: tau_b_D" ${FOLDER}/garbage.csv)
file(WRITE ${FOLDER}/garbage.csv "${header}1,1,0.3\n")
expect(2 "garbage.csv:2: 3 columns" ${FOLDER}/garbage.csv)
file(WRITE ${FOLDER}/garbage.csv "what,is,this\n")
expect(2 "garbage.csv:1: no column tau_f_D" ${FOLDER}/garbage.csv)
expect(2 "cannot be read" ${FOLDER}/missing.csv)
expect(2 "unknown method" ${FILE} --method guess)
