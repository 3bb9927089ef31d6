% GNU Octave's package quaternion, in double. Its numbers are w, x, y, z. The process protocol of docs/adapters.md.
1;
pkg load quaternion
warning("off", "all")  % rot2q says that it normalizes the axis

function q = of(Q)
  q = quaternion(Q(4), Q(1), Q(2), Q(3));
end
function Q = numbers(q)
  Q = [q.x, q.y, q.z, q.w];
end
function q = nearer(q)  % the rotation's logarithm is that of q or -q with w >= 0
  if q.w < 0, q = -q; end
end
function phi = twice(q)
  [v, theta] = q2rot(q);
  phi = theta * v';
end
function q = rotation(phi)  % any axis for the angle 0; rot2q normalizes the axis
  q = rot2q(phi + [!any(phi), 0, 0], norm(phi));
end
function line = read_line()  % fgetl would wait for the character after the end of the line
  line = "";
  while ! isempty(c = fread(stdin, 1, "uint8=>char")) && c != "\n", line(end + 1) = c; end
end
function y = answer(operation, x)
  switch operation
    case "exp3_quaternion", y = numbers(rotation(x));
    case "log3_quaternion", y = twice(nearer(of(x)));
    case "log3_matrix", y = twice(nearer(rotm2q(reshape(x, 3, 3)')));
    case "rotate_point", r = of(x) * quaternion(x(5), x(6), x(7)) * conj(of(x)); y = [r.x, r.y, r.z];
    case "normalize", y = numbers(unit(of(x)));
  end
  y(imag(y) != 0) = NaN;  % fwrite would leave the imaginary parts out
end

sizes = struct("exp3_quaternion", [3, 4], "log3_quaternion", [4, 3], "log3_matrix", [9, 3], ...
               "rotate_point", [7, 3], "normalize", [4, 4]);
head = 'pkg load quaternion\n';
exponential = 'phi = [{phi}]; q = rot2q(phi + [!any(phi), 0, 0], norm(phi));\n';
logarithm = 'if q.w < 0, q = -q; end\n[v, theta] = q2rot(q); printf(\"%.17g \", theta * v)';
source = {"exp3_quaternion", [head, exponential, 'printf(\"%.17g \", [q.x, q.y, q.z, q.w])'];
          "log3_quaternion", [head, 'Q = [{Q}]; q = quaternion(Q(4), Q(1), Q(2), Q(3));\n', logarithm];
          "log3_matrix", [head, 'q = rotm2q(reshape([{R}], 3, 3)'');\n', logarithm];
          "normalize", [head, 'Q = [{Q}]; q = unit(quaternion(Q(4), Q(1), Q(2), Q(3)));\nprintf(\"%.17g \", [q.x, q.y, q.z, q.w])']};
version_of = ver("quaternion").Version;
offered = strjoin(cellfun(@(o) ['"', o, '": ["double"]'], fieldnames(sizes)', "UniformOutput", false), ", ");
programs = strjoin(cellfun(@(o, s) ['"', o, '": "', s, '"'], source(:, 1)', source(:, 2)', "UniformOutput", false), ", ");
read_line();  % "liecheck 1"
fdisp(stdout, ['{"protocol": 1, "name": "octave_quaternion", "version": "', version_of, '", "operations": {', offered, '}, "source": {', programs, '}}']);
fflush(stdout);
while ! isempty(call = read_line())  % "call exp3_quaternion double 128"
  words = strsplit(call, " ");
  n = str2double(words{4});
  size_of = sizes.(words{2});
  x = fread(stdin, [size_of(1), n], "double")';
  y = zeros(n, size_of(2));
  status = zeros(1, n);
  for i = 1:n
    try
      y(i, :) = answer(words{2}, x(i, :));
    catch
      status(i) = 1;
    end
  end
  printf("done %d\n", n);
  fwrite(stdout, status, "uint8");
  fwrite(stdout, y', "double");
  fflush(stdout);
end
