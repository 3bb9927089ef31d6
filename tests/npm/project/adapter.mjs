import * as mylib from "./mylib.mjs";

export const name = "mylib_javascript", version = "1.0", conventions = {quaternion: "wxyz"};
const array = ({w, x, y, z}) => [w, x, y, z];

export const exp3_quaternion = phi => array(mylib.exp(phi));
export const exp3_matrix = phi => mylib.matrix([...phi]);
export const log3_quaternion = ([w, x, y, z]) => mylib.log({w, x, y, z});
export const normalize = ([w, x, y, z]) => array(mylib.normalized({w, x, y, z}));
export const left_jacobian6 = xi => mylib.leftJacobian(xi.slice(0, 3), xi.slice(3));
export function inverse(X) {
  const {R, p} = mylib.inverse([X.slice(0, 3), X.slice(3, 6), X.slice(6, 9)], X.slice(9));
  return [...R, p];
}
