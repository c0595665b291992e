/** The words that programs print around numbers: headings, kinds, and names of components. */
import type { DumpKind } from '../../model/dump.ts';

/** Words that say what the numbers are; the first match decides. */
const KINDS: readonly (readonly [RegExp, DumpKind])[] = [
  [/^normals?$/, 'normals'],
  [/^(vertex|vertices|verts?|skin|skinned|deformed|mesh)$/, 'vertices'],
  [/^(channels?|curves?)$/, 'channels'],
  [/^(local|locals)$/, 'local'],
  [/^(world|global|globals)$/, 'world'],
  [/^(positions?|origins?|pivots?)$/, 'positions'],
];

/** The kind that a heading states; undefined if none. */
export function kindOf(words: readonly string[]): DumpKind | undefined {
  return KINDS.find(([pattern]) => words.some((word) => pattern.test(word)))?.[1];
}

/** Words of headings, and those that print functions put before numbers. They are nobody's name. */
const PLAIN = new Set(
  (
    'a all and are array at b binding bone bones by character count curve curves data deformed dmat dmat3x4 dmat4x4 dump dvec3 ' +
    'each fmat4x4 for frame from fvec3 global globals heading id idx in index index: is joint joints list local locals ' +
    'mat mat3x4 mat4 mat4x3 mat4x4 matrices matrix matrix4 matrix4d matrix4f matrix4x4 mesh mvec3 my n node nodes normal ' +
    'normals num number numbers of one or order origin origins out output per pivot pivots point points pos pose position ' +
    'positions result results row rows s sec second seconds skin skinned space t tensor the time times to transform ' +
    'transformation transformations transforms v value values vec vec3 vec4 vector vector3 vector3f vert vertex vertices ' +
    'verts vtx with world xform xforms glm std np numpy eigen math deg degrees rad radians ms cm mm m meter meters metre metres unit ' +
    'units hz fps equals none float32array float64array float double dtype float32 float64 mine theirs student'
  ).split(' '),
);

/** Whether a word, in lower case, is nobody's name. */
export function isPlain(word: string): boolean {
  return PLAIN.has(word) || isComponent(word) || /^\d+x\d+$|^[°\u00b7\u00d7]$/.test(word);
}

/** Names of numbers within a row: `x`, `ny`, `m00`, `M11`, `row0`, `Translation`. */
export function isComponent(word: string): boolean {
  return /^(n?[xyzw]|[xyz]n|n[_.][xyz]|p[_.]?[xyz]|[rgbuo]|m_?[0-4]_?[0-4]|e\d\d?|r\d|c\d|rows?_?\d?|col(umn)?s?_?\d?|elements|basis|translation)$/.test(
    word,
  );
}

/** Words after which a whole number is an index: `joint 7`, `vertex #3`. */
export function isIndexWord(word: string): boolean {
  return /^(joint|bone|node|vertex|vert|vtx|normal|point|position|pos|matrix|mat|index|idx|id|world|local|[jvnpm])$/.test(
    word,
  );
}

/** Whether a word in lower case announces the number of a channel: `channel 7`. */
export function isChannelWord(word: string): boolean {
  return /^(channel|chan|ch|curve)$/.test(word);
}

/** Words for several items, of which a line with a count says how many there are. */
export function isPluralNoun(word: string): boolean {
  return /^(matrices|positions|vertices|verts|normals|channels|transforms|transformations|joints|bones)$/.test(word);
}

/** Whether the names, in lower case, are those of columns. */
export function areColumns(names: readonly string[]): boolean {
  return names.length > 1 && names.every((name) => isColumn(name)) && names.some((name) => isPlainColumn(name));
}

function isColumn(name: string): boolean {
  return (
    isComponent(name) ||
    isPlainColumn(name) ||
    /^(name|joint|bone|node|vertex|vert|index|idx|id|i|#|m?\d{2}|a?[0-3][0-3])$/.test(name) ||
    channelOfColumn(name) !== undefined
  );
}

/** Whether a column's name in lower case says that it holds seconds: `t`, `time`, `time_s`. */
export function isTimeColumn(name: string): boolean {
  return /^(time(_?s(ec(onds)?)?)?|t|seconds)$/.test(name);
}

/** Whether a name is of a column, whatever stands beside it. */
export function isPlainColumn(name: string): boolean {
  return isTimeColumn(name) || name === 'frame' || /^(n?[xyz]|m_?\d_?\d|px|py|pz|vx|vy|vz)$/.test(name);
}

/** Columns that label their row. */
export function isLabelColumn(name: string): boolean {
  return /^(name|joint|bone|node|vertex|vert|index|idx|id|i|#)$/.test(name);
}

/** `ch3`, `channel 3`, `value[3]`: 3. */
function channelOfColumn(name: string): number | undefined {
  const found = /^(?:channel|chan|ch|curve|value|val|v|c|dof)?[\s_[(#]*(\d+)[\])]*$/.exec(name)?.[1];
  return found === undefined ? undefined : Number(found);
}
