/** Numbers and words that a reader must not take at their word. */

export const EXTREME_NUMBERS = [
  ...['0', '-0', '1', '-1', '2', '3', '7', '0.5', '1e308', '-1e308', '1.7976931348623157e308', '1e-300', '5e-324'],
  ...['1e-7', '1e15', '1e300', '9007199254740992', '9007199254740993', '4294967295', '4294967296', '2147483648'],
  ...['65535', '1e9', '1e5', '99999999999999999999', '1e999', '-1e999', 'nan', 'NaN', 'inf', '-Infinity', '0x10'],
  ...['1,5', '12x5', '1.2.3', '1e', '1e+', '.', '-', '+.5', '-.5e-3', '00', '0.1234567890123456789', '1e5e5', '--1'],
  ...['100000', '-100000', '100001', '3.4e38', '1e39', '1e154', '1e155', '1e102', '0.30000000000000004', '1e21'],
  ...['1e-400'],
] as const;

export const EXTREME_INTEGERS = [
  ...[0, 1, 2, 3, 255, 256, 65535, 65536, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff, 0x10000000, 0xfffffff],
  ...[5120, 5121, 5122, 5123, 5125, 5126],
] as const;

export const LONG_LENGTHS = [1, 63, 64, 65, 199, 200, 201, 1000, 1023, 1024, 1025, 5000] as const;

/** Of all formats: one's keyword may be another's name. */
export const WORDS = [
  ...['{', '}', '{}', '{ }', '}}', '[', ']', '[]', ',', ':', ';', '"', '""', '"a b"', "'", '\n', '\r', '\r\n', '\t'],
  ...['\0', '\u00a0', '\u2028', '\ud800', 'ü', '骨', '\u{1F9B4}', '\uFEFF', '__proto__', 'constructor', 'toString'],
  ...['<b>', '../../a', 'true', 'null', 'end', 'foo', 'foo {', 'foo { bar', '#0.rx', '#1', 'a.b', '=1+1', '%s', '\\'],
  ...['balljoint', 'hingejoint', 'freejoint', 'compoundjoint', 'scalejoint', 'quaternionjoint', 'fixedjoint'],
  ...['offset', 'pose', 'limit', 'rx', 'rz', 'sx', 'boxmin', 'role', 'order', 'axis', 'mode', 'volume', 'dofs'],
  ...['pitch'],
  ...['couple', 'couple rx #0.ry 1 0', 'length', 'xzy', 'rotxlimit -1 1', 'balljoint{}', 'limit rx 1 -1'],
  ...['positions', 'normals', 'texcoords', 'skinweights', 'triangles', 'bindings', 'matrix', 'material', 'texture'],
  ...['color', 'animation', 'range', 'numchannels', 'channel', 'extrapolate', 'constant', 'bounce', 'cycle', 'keys'],
  ...['flat', 'smooth', 'linear', 'fixed', 'keys 2 {', 'channel {', 'material a {', 'triangles 1 { 0 1 2 }'],
  ...['HIERARCHY', 'ROOT', 'ROOT a {', 'JOINT', 'JOINT{}', 'JOINT b c', 'End Site', 'End Site {}', 'OFFSET'],
  ...['CHANNELS', 'channel 0 {', 'channel x 3 {', 'matrix 1{', 'balljoint 0 a {', '1.5 {', 'OFFSET 0 1 0 2 3 4'],
  ...['0 1 0 -1\n', '1 2 3 0\n', '%YAML', '<html>', 'version https://git-lfs.github.com/spec/v1\n'],
  ...['CHANNELS 0', 'Xposition', 'Zrotation', 'MOTION', 'Frames:', 'Frame Time:', 'Time:', '\n1 2 3\n', 'Frames: 1e9'],
  ...['rig', 'skeleton', 'skin', 'morphs', 'a.skel', 'b c.skin', 'weight', 'joint', 'root', 'time', 'world', 'frame'],
  ...['v 1 2 3\n', 'vn', 'ply\n', 'end_header', '"end": 1', '"time": 1e400', '-0', '0', '1', '-1', '1e9', '2', '3'],
] as const;
