// Where the middle of the psi table is: lib/psi_table.glsl says of what. Read by C++ and by GLSL.
const float kPsiTableMiddle = 4.0;
