# Math::Quaternion, in double. Its numbers are w, x, y, z. The process protocol of docs/adapters.md.
use strict;
use warnings;
use Math::Quaternion;

sub rotation {    # any axis for the angle 0; rotation() normalizes the axis
  my ($x, $y, $z) = @_;
  my $angle = sqrt($x * $x + $y * $y + $z * $z);
  return Math::Quaternion::rotation($angle, $angle ? ($x, $y, $z) : (1, 0, 0));
}
sub xyzw { my @q = @{$_[0]}; return (@q[1, 2, 3], $q[0]); }
sub quaternion { return Math::Quaternion->new(@_[3, 0, 1, 2]); }

# The angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0.
sub log3_quaternion {
  my $q = quaternion($_[3] < 0 ? map { -$_ } @_ : @_);
  my $angle = $q->rotation_angle;
  return map { $angle * $_ } $q->rotation_axis;
}

my $head = "use Math::Quaternion;\n\$, = ' ';\n";
my $named = "my (\$x, \$y, \$z, \$w) = ({Q});\n";
my %functions = (
  exp3_quaternion => [sub { xyzw(rotation(@_)) }, 3, 4,
    $head . "my \@phi = ({phi}); my \$angle = sqrt(\$phi[0]**2 + \$phi[1]**2 + \$phi[2]**2);\nmy \$q = Math::Quaternion::rotation(\$angle, \$angle ? \@phi : (1, 0, 0));\nprint map { sprintf '%.17g', \$_ } \@\$q[1, 2, 3], \$\$q[0];"],
  log3_quaternion => [\&log3_quaternion, 4, 3,
    $head . $named . "my \$s = \$w < 0 ? -1 : 1;\nmy \$q = Math::Quaternion->new(map { \$s * \$_ } \$w, \$x, \$y, \$z);\nprint map { sprintf '%.17g', \$q->rotation_angle * \$_ } \$q->rotation_axis;"],
  rotate_point => [sub { quaternion(@_[0 .. 3])->rotate_vector(@_[4 .. 6]) }, 7, 3],
  normalize => [sub { xyzw(quaternion(@_)->normalize) }, 4, 4,
    $head . $named . "my \$q = Math::Quaternion->new(\$w, \$x, \$y, \$z)->normalize;\nprint map { sprintf '%.17g', \$_ } \@\$q[1, 2, 3], \$\$q[0];"],
  slerp => [sub { xyzw(Math::Quaternion::slerp(quaternion(@_[0 .. 3]), quaternion(@_[4 .. 7]), $_[8])) }, 9, 4,
    $head . "my \@Q0 = ({Q0}); my \@Q1 = ({Q1});\nmy \$q = Math::Quaternion::slerp(map({ Math::Quaternion->new(\@\$_[3, 0, 1, 2]) } \\\@Q0, \\\@Q1), {t});\nprint map { sprintf '%.17g', \$_ } \@\$q[1, 2, 3], \$\$q[0];"],
  rotation_between => [sub { xyzw(Math::Quaternion::rotation([@_[0 .. 2]], [@_[3 .. 5]])) }, 6, 4,
    $head . "my \$q = Math::Quaternion::rotation([{a}], [{b}]);\nprint map { sprintf '%.17g', \$_ } \@\$q[1, 2, 3], \$\$q[0];"],
);

sub text { my $t = shift; $t =~ s/(["\\])/\\$1/g; $t =~ s/\n/\\n/g; return "\"$t\""; }

binmode STDIN;
open(my $answers, '>&', \*STDOUT) or die;
binmode $answers;
open(STDOUT, '>&', \*STDERR) or die;    # what the library prints must not come between the answers
$answers->autoflush(1);
<STDIN>;                                # "liecheck 1"
print $answers '{"protocol": 1, "name": "math_quaternion", "version": "', $Math::Quaternion::VERSION, '", "operations": {',
  join(', ', map { "\"$_\": [\"double\"]" } sort keys %functions), '}, "source": {',
  join(', ', map { "\"$_\": " . text($functions{$_}[3]) } grep { $functions{$_}[3] } sort keys %functions), "}}\n";
while (my $call = <STDIN>) {    # "call exp3_quaternion double 128"
  my (undef, $operation, undef, $n) = split ' ', $call;
  my ($f, $size, $result_size) = @{$functions{$operation}};
  read(STDIN, my $bytes, 8 * $n * $size);
  my @inputs = unpack('d<*', $bytes);
  my ($status, @results) = ('');
  for my $i (0 .. $n - 1) {
    my @result = eval { $f->(@inputs[$i * $size .. ($i + 1) * $size - 1]) };
    $status .= $@ ? "\1" : "\0";
    # Where acos takes a number above 1, Math::Trig returns a complex number.
    push @results, $@ ? (0) x $result_size : map { ref $_ ? 'nan' : $_ } @result;
  }
  print $answers "done $n\n", $status, pack('d<*', @results);
}
