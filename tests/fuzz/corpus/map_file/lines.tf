# value r g b sigma
0 1 0 0 5
1 0 1 0 6
