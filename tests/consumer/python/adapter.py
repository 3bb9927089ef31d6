import mylib


class MyLib:  # served by `python3 -m liecheck`; the functions of mylib take and give NumPy arrays
    name, version, conventions = "mylib_python", "1.0", "quaternion: wxyz"
    exp3_quaternion = mylib.exp
    exp3_matrix = mylib.matrix
    log3_quaternion = mylib.log
    left_jacobian6 = mylib.left_jacobian  # takes rho and phi, the parts of xi
    inverse = mylib.inverse  # takes and gives R and p
