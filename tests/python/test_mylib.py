import liecheck
import mylib


class MyLib:
    conventions = "quaternion: wxyz"
    exp3_quaternion = mylib.exp
    exp3_matrix = mylib.matrix
    log3_quaternion = mylib.log
    left_jacobian6 = mylib.left_jacobian
    inverse = mylib.inverse

    @liecheck.operation("act_point")
    def moved(self, X, p):
        return X[:3, :3] @ p + X[:3, 3]


test_mylib = liecheck.subject(MyLib())
